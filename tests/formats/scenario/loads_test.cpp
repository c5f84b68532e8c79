// [seismic], gravity.direction and [[load]]: good scenarios value by value, and what is wrong with others.

#include "scenario_texts.h"
#include "talus/formats/failing.h"
#include "talus/formats/overrides.h"
#include "talus/simulation.h"

namespace talus::formats {

namespace {

constexpr double kDeg = 3.14159265358979323846 / 180;

/// The fields of what is wrong with a stack and these lines.
std::string faults(const std::string& text) {
    std::string fields;
    for (const Error& error : readBad(properties() + stack() + text)) {
        CHECK(error.line > 0);
        CHECK(error.column > 0);
        fields += (fields.empty() ? "" : ", ") + error.field;
    }
    return fields;
}

}  // namespace

TEST_CASE("scenario: earthquake and direction of gravity") {
    const Model model = readGood(
                            "[seismic]\nhorizontal = 0.15\ndirection_deg = 90\nvertical = -0.05\n"
                            "[gravity]\ndirection = [0, 1, -2]\n" +
                            properties() + stack())
                            .model;
    CHECK(model.seismic.horizontal == 0.15);
    CHECK(model.seismic.azimuth == doctest::Approx(90 * kDeg).epsilon(1e-15));
    CHECK(model.seismic.vertical == -0.05);
    CHECK(*model.gravity.direction == Vec3(0, 1, -2));
    const Model plain = readGood(properties() + stack()).model;
    CHECK(plain.seismic.horizontal == 0);
    CHECK(plain.seismic.azimuth == doctest::Approx(270 * kDeg).epsilon(1e-15));
    CHECK_FALSE(plain.gravity.direction.has_value());
}

TEST_CASE("scenario: loads of every kind") {
    const Model model =
        readGood(properties() + stack() +
                 "[[load]]\nblock = \"c3r2s1\"\nforce = [1, 2, -5e4]\npoint = [0.5, 0.02, 0.2]\n"
                 "factor = [[0.0, 0.0], [1.0, -1.5]]\n"
                 "[[load]]\nblock = \"c1r2s2\"\nface = \"+z\"\npressure = 2e4\n"
                 "[[load]]\nbox = { min = [0, 0, 0.05], max = [5, 8, 11] }\nface = \"-x\"\npressure = 1e3\n")
            .model;
    REQUIRE(model.loads.size() == 3);
    const AppliedLoad &force = model.loads[0], &face = model.loads[1], &box = model.loads[2];
    CHECK((force.kind == AppliedLoad::Kind::force));
    CHECK(model.blocks[static_cast<std::size_t>(force.block)].name == "c3r2s1");
    CHECK(force.force == Vec3(1, 2, -5e4));
    CHECK(*force.point == Vec3(0.5, 0.02, 0.2));
    REQUIRE(force.factor.size() == 2);
    CHECK(force.factor[1].time == 1.0);
    CHECK(force.factor[1].value == -1.5);
    CHECK((face.kind == AppliedLoad::Kind::face));
    CHECK(face.direction == Vec3(0, 0, 1));
    CHECK(face.pressure == 2e4);
    CHECK((box.kind == AppliedLoad::Kind::box));
    CHECK(box.direction == Vec3(-1, 0, 0));
    CHECK(box.box_min == Vec3(0, 0, 0.05));
    CHECK(box.box_max == Vec3(5, 8, 11));
    CHECK(checkModel(model).empty());
}

TEST_CASE("scenario: what is wrong with an earthquake or a direction") {
    CHECK(faults("[seismic]\nhorizontal = -0.1\n") == "seismic.horizontal");
    CHECK(faults("[seismic]\nvertical = 1.0\n") == "seismic.vertical");
    CHECK(faults("[seismic]\nhorizontal = \"much\"\n") == "seismic.horizontal");
    CHECK(faults("[seismic]\nhorizontl = 0.1\n") == "seismic.horizontl");
    CHECK(faults("[seismic]\ndirection_deg = 400\n") == "seismic.direction_deg");
    CHECK(faults("[gravity]\ndirection = [0, 0, 0]\n") == "gravity.direction");
    CHECK(faults("[gravity]\ndirection = [0, 1]\n") == "gravity.direction");
    CHECK(faults("[gravity]\ndirection = [0, 0, -1]\ntilt_deg = 3\n") == "gravity.direction");
}

TEST_CASE("scenario: what is wrong with a load") {
    CHECK(faults("[[load]]\nblock = \"c9r1s1\"\nforce = [1, 0, 0]\n") == "load[0].block");
    CHECK(faults("[[load]]\nforce = [1, 0, 0]\n") == "load[0].block");
    CHECK(faults("[[load]]\nblock = \"c1r1s1\"\n") == "load[0].force");
    CHECK(faults("[[load]]\nblock = \"c1r1s1\"\nforce = [1, 0]\n") == "load[0].force");
    CHECK(faults("[[load]]\nblock = \"c1r1s1\"\npressure = 1e3\n") == "load[0].face");
    CHECK(faults("[[load]]\nblock = \"c1r1s1\"\npressure = -1\nface = \"+z\"\n") == "load[0].pressure");
    CHECK(faults("[[load]]\nblock = \"c1r1s1\"\npressure = 1\nface = \"up\"\n") == "load[0].face");
    CHECK(faults("[[load]]\nblock = \"c1r1s1\"\nforce = [1, 0, 0]\nface = \"+z\"\n") == "load[0].face");
    CHECK(faults("[[load]]\nbox = { min = [0, 0, 0], max = [1, 0, 1] }\nface = \"+z\"\npressure = 1\n") ==
          "load[0].box.max");
    CHECK(faults("[[load]]\nblock = \"c1r1s1\"\nforce = [1, 0, 0]\nfactor = [[1, 1], [1, 2]]\n") ==
          "load[0].factor[1]");
    CHECK(faults("[[load]]\nblock = \"c1r1s1\"\nforce = [1, 0, 0]\nfactor = [[-1, 1]]\n") ==
          "load[0].factor[0][0]");
}

TEST_CASE("scenario: a box that catches no face, and a load on the floor, are found with their place") {
    for (const auto& [load, field, line] :
         {std::tuple{"[[load]]\nbox = { min = [5, 5, 5], max = [6, 6, 6] }\nface = \"+z\"\npressure = 1\n",
                     "load[0].box", 13},
          {"[[load]]\nforce = [0, 0, 1]\nblock = \"floor\"\n", "load[0].block", 14}}) {
        const Scenario scenario = readGood(properties() + stack() + load);
        const auto errors = placed(scenario, checkModel(scenario.model));
        REQUIRE(errors.size() == 1);
        CHECK(errors[0].field == field);
        CHECK(errors[0].line == line);
    }
}

TEST_CASE("scenario: earthquakes can be overridden, a tilt beside a direction cannot") {
    Scenario scenario = readGood("[gravity]\ndirection = [0, 0, -1]\n" + properties() + stack());
    CHECK(applyOverride(scenario, "seismic.horizontal", 0.3));
    CHECK(applyOverride(scenario, "seismic.direction_deg", 90));
    CHECK(scenario.model.seismic.horizontal == 0.3);
    CHECK(scenario.model.seismic.azimuth == doctest::Approx(90 * kDeg).epsilon(1e-15));
    CHECK_FALSE(applyOverride(scenario, "seismic.horizontal", -1));
    CHECK_FALSE(applyOverride(scenario, "gravity.tilt_deg", 5));
}

TEST_CASE("failing scenarios: a shaken one, a tilted direction, loads as they were at time 0") {
    const Scenario before =
        readGood("[gravity]\ndirection = [0, 0, -2]\n" + properties() + stack() +
                 "[[load]]\nblock = \"c1r1s1\"\nforce = [1, 0, 0]\nfactor = [[0.0, 0.5], [1.0, 2.0]]\n");
    FailingLoad load;
    load.varied = Varied::horizontal;
    load.value = 0.21;
    load.frame_interval = 0.01;
    const auto shaken = failingScenario(before, load, "");
    REQUIRE(shaken.ok());
    CHECK(shaken->model.seismic.horizontal == 0.21);
    CHECK(parseScenario(shaken->text, "again.toml")->model.seismic.horizontal == 0.21);
    for (const Model& model : {shaken->model, parseScenario(shaken->text, "again.toml")->model})
        for (const LevelPoint& point : model.loads[0].factor) CHECK(point.value == 0.5);
    load.varied = Varied::tilt;
    load.value = 20 * kDeg;
    const auto tilted = failingScenario(before, load, "");
    REQUIRE(tilted.ok());
    const Vec3 read = *parseScenario(tilted->text, "again.toml")->model.gravity.direction;
    CHECK((read - Vec3(-std::sin(20 * kDeg), 0, -std::cos(20 * kDeg))).norm() < 1e-12);
}

}  // namespace talus::formats
