// A scenario as it fails: what a search changes is written out, everything else reads as before.

#include <doctest/doctest.h>

#include <cmath>

#include "formats/scenario/scenario_texts.h"
#include "talus/formats/failing.h"

using namespace talus;
using namespace talus::formats;

namespace {

constexpr double kDegree = 0.017453292519943295;

const char* const kText =
    "[gravity]\ntilt_deg = 5.0\n[analysis]\nstop_deg = 30.0\n[run]\ntime_step_s = 1e-6\nwatch = "
    "[\"c1r1s1\"]\n"
    "[damping]\nlocal = 0.5\nmass = 1.0\n[material.rock]\ndensity = 2700.0\n"
    "[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 30.0\ncohesion = 100.0\n"
    "residual_cohesion = 10.0\ntensile_strength = 50.0\n"
    "[joint.clay]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 20\nresidual_friction_deg = "
    "15.0\n"
    "[[stack]]\ncolumns = 2\nrows = 2\nslices = 1\nblock = [0.2, 0.1, 0.1]\n"
    "bed_friction_deg = [[30.0, 25.0], [30.0, 28.0]]\n"
    "[[interface]]\nbetween = [\"c1r1s1\", \"c2r1s1\"]\njoint = \"clay\"\nfriction_deg = 12.0\ncohesion = "
    "40.0\n"
    "[[water]]\nfissure = 1\nlevels = [[0.0, 0.05], [1.0, 0.15]]\n";

Scenario original() { return *parseScenario(kText, "slope.toml"); }

double reducedBy(double factor, double angle_deg) {
    return std::atan(std::tan(angle_deg * kDegree) / factor);
}

/// The scenario of a text as it fails at a factor of safety of 1.25.
Scenario atFactor(const std::string& text) {
    FailingLoad load;
    load.varied = Varied::factor;
    load.value = 1.25;
    load.frame_interval = 0.01;
    auto after = failingScenario(*parseScenario(text, "slope.toml"), load, "");
    REQUIRE(after.ok());
    return std::move(*after);
}

}  // namespace

TEST_CASE("strengths are divided wherever the file gives them; joints keep their number and order") {
    const Scenario before = original();
    FailingLoad load;
    load.varied = Varied::factor;
    load.value = 1.25;
    load.frame_interval = 0.01;
    const auto after = failingScenario(before, load, "first line\nsecond line");
    REQUIRE(after.ok());
    CHECK(after->text.starts_with("# first line\n# second line\n"));
    REQUIRE(after->model.joints.size() == before.model.joints.size());
    for (std::size_t j = 0; j < before.model.joints.size(); ++j) {
        const Joint &a = before.model.joints[j], &b = after->model.joints[j];
        CAPTURE(a.name);
        CHECK(b.friction == doctest::Approx(reducedBy(1.25, a.friction / kDegree)).epsilon(1e-12));
        CHECK(b.residual_friction ==
              doctest::Approx(reducedBy(1.25, a.residual_friction / kDegree)).epsilon(1e-12));
        CHECK(b.cohesion == doctest::Approx(a.cohesion / 1.25).epsilon(1e-12));
        CHECK(b.residual_cohesion == doctest::Approx(a.residual_cohesion / 1.25).epsilon(1e-12));
        CHECK(b.tensile_strength == a.tensile_strength);
        CHECK(b.normal_stiffness == a.normal_stiffness);
    }
    CHECK(after->model.gravity.tilt == before.model.gravity.tilt);
}

TEST_CASE("the model is the search's to the bit; the text reads back as it but for the rounding of degrees") {
    const Scenario before = original();
    FailingLoad load;
    load.varied = Varied::factor;
    load.value = 1.37;
    load.contact_damping = 1.0 / 3;
    load.frame_interval = 0.01;
    const auto after = failingScenario(before, load, "");
    REQUIRE(after.ok());
    CHECK(after->model.gravity.tilt == before.model.gravity.tilt);
    const auto read = parseScenario(after->text, "again.toml");
    REQUIRE(read.ok());
    REQUIRE(read->model.joints.size() == before.model.joints.size());
    for (std::size_t j = 0; j < before.model.joints.size(); ++j)
        for (const JointProperty& property : kJointProperties) {
            CAPTURE(property.key);
            const double exact = after->model.joints[j].*property.value;
            CHECK(exact == reduced(before.model.joints[j], 1.37).*property.value);
            CHECK(read->model.joints[j].*property.value == doctest::Approx(exact).epsilon(1e-15));
        }
    CHECK(read->model.gravity.tilt == before.model.gravity.tilt);
    CHECK(read->model.damping.contact == 1.0 / 3);
    CHECK(read->model.analysis.stop == doctest::Approx(after->model.analysis.stop).epsilon(1e-15));
    CHECK(read->model.run.duration == after->model.run.duration);
    for (const LevelPoint& point : after->model.waters[0].level) CHECK(point.value == 0.05);
}

TEST_CASE("elevations over time are held at the first, as levels are") {
    const std::string levels = "levels = [[0.0, 0.05], [1.0, 0.15]]";
    std::string text = kText;
    text.replace(text.find(levels), levels.size(), "elevations = [[0.0, 0.05], [1.0, 0.15]]");
    const Scenario after = atFactor(text);
    const auto read = parseScenario(after.text, "again.toml");
    REQUIRE(read.ok());
    REQUIRE(read->model.waters[0].level.size() == 2);
    for (const LevelPoint& point : read->model.waters[0].level) CHECK(point.value == 0.05);
}

TEST_CASE("strengths over time are held at the first, and divided") {
    std::string text = kText;
    text.insert(text.find("[joint.clay]"), "strength_over_time = [[0.0, 0.8], [1.0, 0.3]]\n");
    const Scenario after = atFactor(text);
    const auto read = parseScenario(after.text, "again.toml");
    REQUIRE(read.ok());
    for (const Model& model : {after.model, read->model}) {
        CHECK(model.joints[0].strength_over_time == std::vector<LevelPoint>{{0, 0.8}, {1, 0.8}});
        CHECK(model.joints[0].cohesion == doctest::Approx(100 / 1.25).epsilon(1e-12));
        CHECK(model.joints[1].strength_over_time.empty());
    }
}

TEST_CASE("strength of every law is divided, also where the file gives no strength_factor") {
    const Scenario before = readGood(
        joint("default", "law = \"barton-bandis\"\njrc = 8\njcs = 5e7\nresidual_friction_deg = 28") +
        joint("table", "law = \"envelope\"\nshear_strength = [[0, 0], [1e5, 9e4]]\nstrength_factor = 0.5") +
        joint("plain", "friction_deg = 30") + material() + stack("bed_joint = \"table\"\n") +
        "[[interface]]\nbetween = [\"c1r1s1\", \"c2r1s1\"]\njoint = \"default\"\njrc = 3\n"
        "[[interface]]\nbetween = [\"c2r1s1\", \"c3r1s1\"]\njoint = \"table\"\nstrength_factor = 0.7\n");
    FailingLoad load;
    load.varied = Varied::factor;
    load.value = 1.37;
    load.frame_interval = 0.01;
    const auto after = failingScenario(before, load, "");
    REQUIRE(after.ok());
    const auto read = parseScenario(after->text, "again.toml");
    REQUIRE(read.ok());
    REQUIRE(read->model.joints.size() == before.model.joints.size());
    for (std::size_t j = 0; j < before.model.joints.size(); ++j) {
        const Joint &old = before.model.joints[j], &now = read->model.joints[j];
        CAPTURE(old.name);
        const double stress = 3e4;
        CHECK(shearStrength(now, stress) ==
              doctest::Approx(shearStrength(old, stress) / 1.37).epsilon(1e-13));
        CHECK(now.jrc == old.jrc);
        CHECK(now.shear_strength == old.shear_strength);
        CHECK(after->model.joints[j].strength_factor == doctest::Approx(now.strength_factor).epsilon(1e-15));
    }
}

TEST_CASE("the tilt is written out, and a search of the new text goes where that of the old one went") {
    const Scenario before = original();
    FailingLoad load;
    load.value = 0.3;
    load.contact_damping = 2e-6;
    load.duration = 3;
    load.frame_interval = 0.02;
    const auto after = failingScenario(before, load, "");
    REQUIRE(after.ok());
    const Model& model = after->model;
    CHECK(model.gravity.tilt == 0.3);
    const auto read = parseScenario(after->text, "again.toml");
    REQUIRE(read.ok());
    CHECK(read->model.gravity.tilt == doctest::Approx(0.3).epsilon(1e-15));
    CHECK(read->model.analysis.stop == doctest::Approx(model.analysis.stop).epsilon(1e-15));
    CHECK(model.analysis.start.value_or(0) == doctest::Approx(5 * kDegree));
    CHECK(model.analysis.stop == doctest::Approx(30 * kDegree));
    CHECK(model.run.duration == 3);
    CHECK(model.run.frame_interval == 0.02);
    CHECK(model.run.watch == std::vector<std::string>{"c1r1s1"});
    CHECK_FALSE(model.run.time_step.has_value());
    CHECK(model.damping.contact == 2e-6);
    CHECK(model.damping.local == 0);
    CHECK(model.damping.mass == 0);
    CHECK(model.joints[0].friction == before.model.joints[0].friction);
}

TEST_CASE("water stands as at time 0") {
    FailingLoad load;
    load.value = 0.3;
    load.frame_interval = 0.01;
    const auto after = failingScenario(original(), load, "");
    REQUIRE(after.ok());
    REQUIRE(after->model.waters.size() == 1);
    for (const LevelPoint& point : after->model.waters[0].level) CHECK(point.value == 0.05);
}
