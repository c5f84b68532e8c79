// talus keyblocks: what it prints, as text and as JSON.

#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "cli/text.h"
#include "tools/program.h"

using namespace talus;
using namespace talus::tools::testing;

namespace {

const std::string kWedge = TALUS_SOURCE_DIR "/bench/verification/wedge-phi-35.toml";

nlohmann::json keyBlocksOf(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "keyblocks");
    arguments.insert(arguments.end(), {"--json", "--quiet", "--threads", "1"});
    const Outcome outcome = runTalus(arguments);
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    return outcome.json();
}

}  // namespace

TEST_CASE("keyblocks: a wedge as JSON") {
    const auto found = keyBlocksOf({kWedge});
    REQUIRE(found.at("blocks").size() == 1);
    REQUIRE(found.at("moving_groups").size() == 1);
    const auto& block = found.at("blocks")[0];
    CHECK(block.at("name") == "wedge");
    CHECK(block.at("removable") == true);
    const auto& group = found.at("moving_groups")[0];
    CHECK(group.at("blocks") == nlohmann::json::array({"wedge"}));
    for (const auto& each : {block, group}) {
        CHECK(each.at("mode") == "wedge");
        CHECK(each.at("joints") == nlohmann::json::array({"default"}));
        CHECK(each.at("safety_factor").get<double>() == doctest::Approx(1.06365).epsilon(1e-4));
        CHECK(each.at("mass_kg").get<double>() ==
              doctest::Approx(2600 * each.at("volume_m3").get<double>()).epsilon(1e-12));
        // The line of intersection, down.
        double squares = 0;
        for (const auto& component : each.at("direction")) squares += std::pow(component.get<double>(), 2);
        CHECK(squares == doctest::Approx(1));
        CHECK(each.at("direction")[2].get<double>() ==
              doctest::Approx(-std::sin(talus::radians(each.at("plunge_deg").get<double>()))));
        std::set<std::pair<double, double>> planes;
        double resisting = 0;
        for (const auto& plane : each.at("planes")) {
            planes.emplace(std::round(plane.at("dip_deg").get<double>() * 1e6) / 1e6,
                           std::round(plane.at("dip_direction_deg").get<double>() * 1e6) / 1e6);
            resisting += plane.at("resistance_n").get<double>();
        }
        CHECK(planes == std::set<std::pair<double, double>>{{40, 130}, {60, 220}});
        CHECK(each.at("resisting_n").get<double>() == doctest::Approx(resisting));
        CHECK(each.at("safety_factor").get<double>() ==
              doctest::Approx(resisting / each.at("driving_n").get<double>()));
    }
    CHECK(found.at("interrupted") == false);
    CHECK(found.at("provenance").at("scenario") == kWedge);
}

TEST_CASE("keyblocks: blocks without a mode have no direction and no factor") {
    const TemporaryFolder folder;
    const auto found = keyBlocksOf({folder.write("level.toml", blockScenario(0, 20))});
    const auto& block = found.at("blocks")[0];
    CHECK(block.at("mode") == "none");
    CHECK(block.at("removable") == true);
    CHECK(block.at("removal_direction")[2].get<double>() == doctest::Approx(1));
    for (const char* key : {"direction", "safety_factor", "trend_deg", "plunge_deg"})
        CHECK(block.at(key).is_null());
    CHECK(block.at("joints").empty());
    CHECK(found.at("moving_groups").empty());
}

TEST_CASE("keyblocks: a joint that is wet in part has its own name and the share for people") {
    const TemporaryFolder folder;
    const std::string slope = folder.write(
        "wet.toml",
        "[gravity]\ntilt_deg = 20.0\n[material.rock]\ndensity = 2700.0\n[joint.default]\n"
        "normal_stiffness = 1e10\nshear_stiffness = 1e10\nfriction_deg = 35.0\nwet_strength_factor = 0.5\n"
        "[[block]]\nname = \"floor\"\nbox = { min = [-2, 0, -1], max = [9, 1, 0] }\nfixed = true\n"
        "[[block]]\nname = \"block\"\nbox = { min = [0, 0, 0], max = [1, 1, 0.5] }\n"
        "[[water]]\nbetween = [\"floor\", \"block\"]\nelevation = 0.136808\n");
    const std::string told = runTalus({"keyblocks", slope, "--quiet"}).out;
    CAPTURE(told);
    CHECK(told.find("slides on default (40 % wet)") != std::string::npos);
    CHECK(told.find('@') == std::string::npos);
}

TEST_CASE("keyblocks: the text is a table that says what is not covered") {
    const Outcome outcome = runTalus({"keyblocks", kWedge, "--threads", "1", "--quiet"});
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.out.find("limit equilibrium, translation only: toppling is not covered") !=
          std::string::npos);
    CHECK(outcome.out.find("wedge on default") != std::string::npos);
    const TemporaryFolder folder;
    const Outcome none = runTalus({"keyblocks", folder.write("level.toml", blockScenario(0, 20)), "--quiet"});
    CHECK(none.out.find("none can move") != std::string::npos);
}

TEST_CASE("keyblocks: as many groups as are wanted; warnings in both outputs; bad input") {
    const TemporaryFolder folder;
    const std::string slope = TALUS_SOURCE_DIR "/bench/examples/rock-slope.toml";
    const auto few = keyBlocksOf({slope, "--most", "2"});
    CHECK(few.at("moving_groups").size() == 2);
    CHECK(few.at("moving_groups")[0].at("safety_factor") <= few.at("moving_groups")[1].at("safety_factor"));
    const auto anchored =
        keyBlocksOf({TALUS_SOURCE_DIR "/bench/verification/hoek-bray-crack-2m-anchored.toml", "--set",
                     "bolt[0].pretension=1e5"});
    REQUIRE(!anchored.at("warnings").empty());
    CHECK(anchored.at("warnings").back().get<std::string>().find("\"anchor\"") != std::string::npos);
    CHECK(runTalus({"keyblocks", slope, "--most", "0"}).exit_code == 2);
    const Outcome missing = runTalus({"keyblocks", folder / "none.toml", "--json"});
    CHECK(missing.exit_code == 2);
    CHECK(missing.json().at("ok") == false);
    std::string loose = blockScenario(0, 20);
    for (std::size_t at = loose.find("fixed = true"); at != std::string::npos;
         at = loose.find("fixed = true"))
        loose.replace(at, 12, "");
    CHECK(runTalus({"keyblocks", folder.write("loose.toml", loose)}).exit_code == 2);
}
