// talus theory: the formulas by numbers, Table 1, and the prediction for a scenario.

#include <doctest/doctest.h>

#include <cmath>

#include "tools/program.h"

using namespace talus::tools::testing;

namespace {

nlohmann::json theory(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "theory");
    arguments.push_back("--json");
    const Outcome outcome = runTalus(arguments);
    REQUIRE(outcome.exit_code == 0);
    return outcome.json();
}

}  // namespace

TEST_CASE("sliding: critical angle and factor of safety") {
    const auto json = theory({"sliding", "--length", "0.4", "--height", "0.5", "--water-depth", "0.35",
                              "--friction", "19.5", "--tilt", "10"});
    CHECK(std::abs(json.at("critical_angle_deg").get<double>() - 13.53) < 0.0051);
    CHECK(json.at("safety_factor").get<double>() > 1);
}

TEST_CASE("toppling, tension crack and the paper's 6 %") {
    CHECK(theory({"toppling", "--length", "0.4", "--height", "1"}).at("critical_angle_deg").get<double>() ==
          doctest::Approx(21.80).epsilon(0.0005));
    const auto crack =
        theory({"crack", "--slope-height", "12", "--face", "60", "--plane", "35", "--crest-distance", "4",
                "--cohesion", "25000", "--friction", "37", "--water-depth", "3"});
    CHECK(crack.at("safety_factor").get<double>() == doctest::Approx(1.247).epsilon(0.0005));
    const auto drop = theory({"drop"});
    CHECK(drop.at("tangent_drop").get<double>() == doctest::Approx(0.0617).epsilon(0.001));
    CHECK(drop.at("share_of_tan_friction_percent").get<double>() == doctest::Approx(17.4).epsilon(0.01));
}

TEST_CASE("Table 1 has the laboratory's averages beside the exact limits") {
    const auto json = theory({"table1", "--friction", "18", "19.5"});
    REQUIRE(json.at("rows").size() == 7);
    CHECK(json["rows"][0].at("fissure").is_null());
    CHECK(json["rows"][0].at("theory_deg")[0].get<double>() == doctest::Approx(18));
    CHECK(json["rows"][3].at("laboratory_deg").get<double>() == 15.4);
    CHECK(std::abs(json["rows"][3].at("theory_deg")[1].get<double>() - 15.56) < 0.0051);
}

TEST_CASE("a strength that changes is taken at time 0, with a warning") {
    const TemporaryFolder folder;
    const std::string slope = folder.write(
        "weakens.toml",
        "[gravity]\ntilt_deg = 10.0\n[material.rock]\ndensity = 2700.0\n[joint.default]\n"
        "normal_stiffness = 1e10\nshear_stiffness = 1e10\nfriction_deg = 35.0\n"
        "strength_over_time = [[0, 1], [10, 0.02]]\n"
        "[[block]]\nname = \"floor\"\nbox = { min = [-2, 0, -1], max = [9, 1, 0] }\nfixed = true\n"
        "[[block]]\nname = \"block\"\nbox = { min = [0, 0, 0], max = [1, 1, 0.5] }\n");
    const std::string told = "joint.default.strength_over_time: this answer is for time 0";
    const auto json = theory({slope});
    REQUIRE(json.at("warnings").size() == 1);
    CHECK(json.at("warnings")[0].get<std::string>().find(told) == 0);
    CHECK(runTalus({"theory", slope}).out.find("\nwarning: " + told) != std::string::npos);
}

TEST_CASE("numbers beyond the formulas are refused") {
    const std::vector<std::string> mass = {"theory", "sliding", "--height", "0.5", "--friction", "20"};
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--length", "nan"},
                                                 {"--length", "-1"},
                                                 {"--length", "inf"},
                                                 {"--length", "1", "--water-depth", "0.6"}}) {
        std::vector<std::string> arguments = mass;
        arguments.insert(arguments.end(), more.begin(), more.end());
        CAPTURE(more.back());
        CHECK(runTalus(arguments).exit_code == 2);
    }
    CHECK(runTalus({"theory"}).exit_code == 2);
}

TEST_CASE("the prediction for a scenario") {
    const TemporaryFolder folder;
    const auto sliding = theory({folder.write("a.toml", blockScenario(0, 20))});
    CHECK(sliding.at("applies") == true);
    CHECK(sliding.at("theory_deg").get<double>() == doctest::Approx(20).epsilon(1e-10));
    CHECK(sliding.at("failure_mode") == "sliding");

    const std::string second =
        "[[block]]\nname = \"on top\"\nbox = { min = [0.0, 0.0, 0.5], max = [0.5, 1.0, 1.0] }\n";
    const auto nothing = theory({folder.write("b.toml", blockScenario(0, 20, second))});
    CHECK(nothing.at("applies") == false);
    CHECK(nothing.at("theory_deg").is_null());
}
