// Settings, materials and joints of good scenarios, value by value.

#include "scenario_texts.h"

namespace talus::formats {

namespace {

constexpr double kDeg = 3.14159265358979323846 / 180;

Model modelOf(const std::string& text) { return readGood(text).model; }

}  // namespace

TEST_CASE("scenario: defaults of everything optional") {
    const Model model = modelOf(properties() + stack());
    CHECK_FALSE(model.analysis.start.has_value());
    CHECK(model.analysis.stop == doctest::Approx(45 * kDeg).epsilon(1e-15));
    CHECK(model.analysis.tolerance == doctest::Approx(0.01 * kDeg).epsilon(1e-15));
    CHECK(model.analysis.factor_tolerance == 0.001);
    CHECK(model.analysis.time_scaling);
    CHECK(model.run.duration == 1.0);
    CHECK_FALSE(model.run.time_step.has_value());
    CHECK(model.run.frame_interval == 0.01);
    CHECK(model.run.watch.empty());
    CHECK((model.run.start == RunSettings::Start::equilibrium));
    CHECK(model.damping.mass == 0);
    CHECK(model.damping.rotation == 0);
    CHECK(model.damping.contact == 0);
    CHECK(model.damping.local == 0);
    CHECK(model.gravity.magnitude == 9.81);
    CHECK(model.gravity.tilt == 0);
    CHECK(model.points.kind == PointRule::Kind::vertex);
    CHECK(model.waters.empty());
    CHECK(model.pair_joints.empty());
}

TEST_CASE("scenario: every setting") {
    const Model model = modelOf(
        "format = 1\n"
        "[analysis]\nstart_deg = -10\nstop_deg = 60.5\ntolerance_deg = 0.1\nfactor_tolerance = 0.01\n"
        "time_scaling = false\n"
        "[run]\nduration_s = 3\ntime_step_s = 1e-6\nframe_interval_s = 0.5\nwatch = [\"c1r2s1\", \"floor\"]\n"
        "start = \"unstressed\"\n"
        "[damping]\nmass = 1\nrotation = 2.5\ncontact = 1e-3\nlocal = 0.8\n"
        "[gravity]\nmagnitude = 10\ntilt_deg = -20\n"
        "[contact]\npoints = \"grid 12\"\n" +
        properties() + stack());
    CHECK(model.analysis.start.value() == doctest::Approx(-10 * kDeg).epsilon(1e-15));
    CHECK(model.analysis.stop == doctest::Approx(60.5 * kDeg).epsilon(1e-15));
    CHECK(model.analysis.tolerance == doctest::Approx(0.1 * kDeg).epsilon(1e-15));
    CHECK(model.analysis.factor_tolerance == 0.01);
    CHECK_FALSE(model.analysis.time_scaling);
    CHECK(model.run.duration == 3.0);
    CHECK(model.run.time_step.value() == 1e-6);
    CHECK(model.run.frame_interval == 0.5);
    CHECK((model.run.start == RunSettings::Start::unstressed));
    CHECK(model.run.watch == std::vector<std::string>{"c1r2s1", "floor"});
    CHECK(model.damping.mass == 1);
    CHECK(model.damping.rotation == 2.5);
    CHECK(model.damping.contact == 1e-3);
    CHECK(model.damping.local == 0.8);
    CHECK(model.gravity.magnitude == 10);
    CHECK(model.gravity.tilt == doctest::Approx(-20 * kDeg).epsilon(1e-15));
    CHECK(model.points.kind == PointRule::Kind::grid);
    CHECK(model.points.grid == 12);
}

TEST_CASE("scenario: rules of contact points") {
    const auto kind = [](const std::string& points) {
        return modelOf("[contact]\npoints = \"" + points + "\"\n" + properties() + stack()).points.kind;
    };
    CHECK(kind("vertex") == PointRule::Kind::vertex);
    CHECK(kind("quarter") == PointRule::Kind::quarter);
    CHECK(kind("corner") == PointRule::Kind::corner);
    CHECK(kind("grid 1") == PointRule::Kind::grid);
    CHECK(kind("grid 64") == PointRule::Kind::grid);
}

TEST_CASE("scenario: a slope steeper than the default stop is no fault as long as no search is described") {
    const Model model = modelOf("[gravity]\ntilt_deg = 60\n" + properties() + stack());
    CHECK(model.gravity.tilt == doctest::Approx(60 * kDeg));
    CHECK(model.analysis.stop == doctest::Approx(75 * kDeg));
    CHECK(modelOf("[gravity]\ntilt_deg = 60\n[analysis]\nstart_deg = 0\n" + properties() + stack())
              .analysis.stop == doctest::Approx(45 * kDeg));
}

TEST_CASE("scenario: joints in the order of the file, every value") {
    const Model model =
        modelOf(material() +
                "[joint.weak]\nnormal_stiffness = 2e8\nshear_stiffness = 3.5e8\nfriction_deg = 20\n"
                "cohesion = 4\ntensile_strength = 5\nresidual_cohesion = 6\n"
                "residual_friction_deg = 17\ndilation_deg = 8\nsoftening_displacement = 0.009\n" +
                joint() + joint("alpha") + stack());
    REQUIRE(model.joints.size() == 3);
    CHECK(model.joints[0].name == "weak");
    CHECK(model.joints[1].name == "default");
    CHECK(model.joints[2].name == "alpha");
    const Joint& weak = model.joints[0];
    CHECK(weak.normal_stiffness == 2e8);
    CHECK(weak.shear_stiffness == 3.5e8);
    CHECK(weak.friction == doctest::Approx(20 * kDeg).epsilon(1e-15));
    CHECK(weak.cohesion == 4);
    CHECK(weak.tensile_strength == 5);
    CHECK(weak.residual_cohesion == 6);
    CHECK(weak.residual_friction == doctest::Approx(17 * kDeg).epsilon(1e-15));
    CHECK(weak.dilation == doctest::Approx(8 * kDeg).epsilon(1e-15));
    CHECK(weak.softening_displacement == 0.009);
    const Joint& plain = model.joints[1];
    CHECK(plain.normal_stiffness == 2e9);
    CHECK(plain.shear_stiffness == 1e9);
    CHECK(plain.cohesion == 0);
    CHECK(plain.tensile_strength == 0);
    CHECK(plain.residual_cohesion == 0);
    CHECK(plain.residual_friction == plain.friction);
    CHECK(plain.dilation == 0);
    CHECK(plain.softening_displacement == 0);
}

TEST_CASE("scenario: materials by row, by stack, by block") {
    const std::string two = "[material.schist]\ndensity = 2500\n";
    const Model rows = modelOf(properties() + two + stack("row_material = [\"schist\", \"granite\"]\n"));
    CHECK(rows.blocks[0].density == 2500);  // the floor is of the lowest row's material
    for (std::size_t i = 1; i < rows.blocks.size(); ++i)
        CHECK(rows.blocks[i].density == (rows.blocks[i].name.find("r1") != std::string::npos ? 2500 : 2700));
    CHECK(modelOf(properties() + two + stack("material = \"schist\"\n")).blocks.back().density == 2500);
    CHECK(modelOf(properties() + stack("row_material = []\n")).blocks.back().density == 2700);
    CHECK(modelOf(properties() + two + block("a", "material = \"schist\"\n")).blocks[0].density == 2500);
    CHECK(modelOf(properties() + block("a")).blocks[0].density == 2700);
}

}  // namespace talus::formats
