// talus validate: counts of a good scenario, places of a bad one's faults.

#include <doctest/doctest.h>

#include "tools/program.h"

using namespace talus::tools::testing;

TEST_CASE("a good scenario is counted") {
    const TemporaryFolder folder;
    const std::string path = folder.write("good.toml", blockScenario(10, 20));
    const Outcome outcome = runTalus({"validate", path, "--json"});
    REQUIRE(outcome.exit_code == 0);
    const nlohmann::json json = outcome.json();
    CHECK(json.at("ok") == true);
    CHECK(json.at("errors").empty());
    CHECK(json.at("blocks") == 2);
    CHECK(json.at("free_blocks") == 1);
    CHECK(json.at("fixed_blocks") == 1);
    CHECK(json.at("joints") == 1);
    CHECK(json.at("waters") == 0);
    CHECK(json.at("provenance").at("scenario") == path);

    const Outcome people = runTalus({"validate", path});
    CHECK(people.exit_code == 0);
    CHECK(people.out.find("2 blocks") != std::string::npos);
}

TEST_CASE("a fault of the text is reported with file, line, column and field") {
    const TemporaryFolder folder;
    const std::string path = folder.write("bad.toml", blockScenario(10, 20, "[run]\nduration_s = -1.0\n"));
    const Outcome outcome = runTalus({"validate", path, "--json"});
    CHECK(outcome.exit_code == 2);
    const nlohmann::json error = outcome.json().at("errors").at(0);
    CHECK(error.at("file") == path);
    CHECK(error.at("field") == "run.duration_s");
    CHECK(error.at("line").get<int>() > 1);
    CHECK(error.at("column").get<int>() >= 1);
    const std::string place = path + ":" + std::to_string(error["line"].get<int>()) + ":" +
                              std::to_string(error["column"].get<int>()) + ": error: run.duration_s: ";
    CHECK(outcome.err.find(place) != std::string::npos);
}

TEST_CASE("a fault of the geometry has its place, too") {
    const TemporaryFolder folder;
    const std::string inside =
        "[[block]]\nname = \"inside\"\nbox = { min = [0.2, 0.2, 0.1], max = [0.8, 0.8, 0.4] }\n";
    const std::string path = folder.write("overlap.toml", blockScenario(10, 20, inside));
    const Outcome outcome = runTalus({"validate", path, "--json"});
    CHECK(outcome.exit_code == 2);
    const nlohmann::json error = outcome.json().at("errors").at(0);
    CHECK(error.at("file") == path);
    CHECK(error.at("line").get<int>() > 1);
}
