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
    const std::string wet =
        folder.write("wet.toml", contentOf(path) + "[[water]]\nsurface = [[0.0, 0.1], [1.0, 0.2]]\n");
    CHECK(runTalus({"validate", wet, "--json"}).json().at("waters") == 1);
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

TEST_CASE("what cannot be meant is refused, with the slip that is likely") {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& scenario, const std::string& field, const std::string& hint) {
        CAPTURE(field);
        const Outcome outcome = runTalus({"validate", folder.write("s.toml", scenario)});
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.err.find(": error: " + field) != std::string::npos);
        CHECK(outcome.err.find(hint) != std::string::npos);
    };
    const auto with = [](std::string from, const std::string& to) {
        std::string text = blockScenario(10, 20);
        return text.replace(text.find(from), from.size(), to);
    };
    const std::string stiff = "normal_stiffness = 1e9", dense = "density = 2600.0";
    refused(with(stiff, "normal_stiffness = 1e18"), "joint.default.normal_stiffness", "at most 1e+15");
    refused(with(stiff, "normal_stiffness = 100"), "joint.default.normal_stiffness", "kPa/m or MPa/m?");
    refused(with(dense, "density = 1e100"), "material.rock.density", "at most 30000");
    refused(with(dense, "density = 2.6"), "material.rock.density", "g/cm3");
    refused(blockScenario(10, 20, "velocity = [1e18, 0, 0]\n"), "block[1].velocity[0]", "at most 1000");
    const std::string water = "[[water]]\nblock = \"key\"\nface = \"+x\"\n";
    refused(blockScenario(10, 20, water + "elevation = 500.0\n"), "water[0]", "near the model");
    refused(blockScenario(10, 20, water + "depth = 500.0\n"), "water[0]", "is it in m?");
    refused(blockScenario(10, 20, "[[water]]\nsurface = [[-1.0, 500.0], [3.0, 505.0]]\n"), "water[0]",
            "near the model");
    for (const char* step : {"0.6", "1e-13"})
        refused(blockScenario(10, 20, std::string("[run]\nduration_s = 1.0\ntime_step_s = ") + step + "\n"),
                "run.time_step_s", "at most half of it");
}

TEST_CASE("values that are allowed but probably unintended give a warning") {
    const TemporaryFolder folder;
    const auto warned = [&](const std::string& scenario, const std::string& hint) {
        const Outcome outcome = runTalus({"validate", folder.write("s.toml", scenario)});
        CHECK(outcome.exit_code == 0);
        CHECK(outcome.out.find(hint) != std::string::npos);
        CHECK(outcome.err.empty());
    };
    warned(blockScenario(0, 0.5), "is it in radians?");
    std::string soft = blockScenario(0, 20);
    warned(soft.replace(soft.find("1e9"), 3, "1e4"), "of its height under its own weight");
    warned(blockScenario(
               0, 20,
               "[[stack]]\nname = \"s\"\norigin = [10.0, 0.0, 0.0]\ncolumns = 2\nrows = 1\nslices = 1\n"
               "block = [0.2, 0.1, 0.1]\n[[water]]\nstack = \"s\"\nfissure = 1\nelevation = -0.02\n"),
           "it wets no free block");
    warned(blockScenario(0, 20, "[[water]]\nblock = \"key\"\nface = \"+x\"\nelevation = -0.02\n"),
           "the lowest of its walls");
    warned(blockScenario(0, 20, "[[water]]\nsurface = [[-1.0, -3.0], [3.0, -3.0]]\n"),
           "it wets no free block");
    warned(blockScenario(0, 20, "[[water]]\nblock = \"key\"\nface = \"+x\"\ndepth = 5.0\n"),
           "m deep in a model");
    std::string text = blockScenario(0, 20);
    text.insert(text.find("tilt_deg"), "magnitude = 9810.0\n");
    warned(text, "is it in mm/s^2?");
    text = blockScenario(0, 20);
    REQUIRE(text.find("fixed = true") != std::string::npos);
    warned(text.replace(text.find("fixed = true"), 12, "fixed = false"), "no fixed or driven block");
    text = blockScenario(0, 20);
    text.insert(text.find("friction_deg"), "dilation_deg = 25.0\n");
    warned(text, "the joint would create energy as it slides");
    warned(blockScenario(
               0, 20,
               "[[block]]\nname = \"splinter\"\nbox = { min = [3, 0, 0], max = [3.001, 0.001, 0.001] }\n"),
           "block \"splinter\" requires time steps");
}
TEST_CASE("Ctrl-C while a large file is read ends the command at once, and is said") {
    std::string text = "[material.r]\ndensity = 2600\n";
    for (int k = 0; text.size() < 20'000'000; ++k)
        text +=
            "[[block]]\nname = \"b" + std::to_string(k) + "\"\nbox = { min = [0, 0, 0], max = [1, 1, 1] }\n";
    const TemporaryFolder folder;
    const std::string scenario = folder.write("large.toml", text);
    folder.write("sweep.toml", "scenario = \"large.toml\"\nanalysis = \"critical-angle\"\n");
    for (const double begun : {0.0, 0.2})  // the first: as soon as it is caught, before the file is opened
        for (const std::vector<std::string>& arguments :
             {std::vector<std::string>{"validate", scenario, "--json"},
              {"batch", folder / "sweep.toml", "-o", folder / "out", "--json"}}) {
            CAPTURE(begun);
            Program program(arguments);
            REQUIRE(waitFor([&] { return program.hasBegun(begun); }));
            program.signal(SIGINT);
            CHECK(program.endsWithin(kSlower * 0.5));
            const Outcome outcome = program.outcome();
            CHECK(outcome.exit_code == 130);
            CHECK(outcome.json()["ok"] == false);
            CHECK(outcome.err.find("interrupted while") != std::string::npos);
        }
}
