// A warning belongs to the answer: text and JSON of every command have it once.

#include <doctest/doctest.h>

#include "tools/program.h"

namespace talus::tools::testing {

namespace {

std::size_t countOf(const std::string& words, const std::string& text) {
    std::size_t count = 0;
    for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++count;
    return count;
}

}  // namespace

TEST_CASE("warnings of the input stand in every answer, once, with --quiet too") {
    const TemporaryFolder folder;
    std::string text = blockScenario(5, 20, "[run]\nduration_s = 0.001\n");
    text.insert(text.find("friction_deg"), "cohesion = 1e3\nresidual_cohesion = 2e3\n");
    const std::string scenario = folder.write("s.toml", text), said = "the joint gets stronger as it slips";
    for (const std::string command : {"validate", "safety-factor", "critical-angle", "critical-acceleration",
                                      "run", "limit-analysis", "keyblocks", "theory", "blocks"}) {
        CAPTURE(command);
        const auto answer = [&](const std::string& option) {
            std::vector<std::string> arguments{command, scenario};
            if (command == "limit-analysis") arguments.insert(arguments.end(), {"--for", "tilt"});
            if (!option.empty()) arguments.push_back(option);
            return runTalus(arguments);
        };
        const Outcome quiet = answer("--quiet"), loud = answer(""), programs = answer("--json");
        CHECK(countOf(said, quiet.out) == 1);
        CHECK(quiet.err.empty());
        CHECK(countOf(said, loud.out + loud.err) == 1);
        CHECK(countOf(said, programs.json().at("warnings").dump()) == 1);
        CHECK(countOf(said, programs.err) == 0);
    }
}

TEST_CASE("water above its joint is told of by every command that computes with it") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write(
        "s.toml",
        "[gravity]\ntilt_deg = 2.0\n[material.rock]\ndensity = 2700.0\n[joint.default]\n"
        "normal_stiffness = 1e10\nshear_stiffness = 1e10\nfriction_deg = 30.0\n[run]\nduration_s = 0.001\n"
        "[[stack]]\ncolumns = 2\nrows = 1\nslices = 1\nblock = [0.2, 0.1, 0.1]\n"
        "[[water]]\nfissure = 1\ndepth = 0.11\n");
    for (const std::string command : {"validate", "safety-factor", "run", "limit-analysis", "keyblocks"}) {
        CAPTURE(command);
        std::vector<std::string> arguments{command, scenario};
        if (command == "limit-analysis") arguments.insert(arguments.end(), {"--for", "factor"});
        const Outcome outcome = runTalus(arguments);
        CHECK(countOf("water[0]: found a depth of 0.11 m", outcome.out) == 1);
    }
}

TEST_CASE("a run without an equilibrium at its start keeps the warnings of its input") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write(
        "s.toml", blockScenario(40, 20,
                                "[run]\nduration_s = 0.001\n[[water]]\nblock = \"key\"\nface = \"-x\"\n"
                                "elevation = -3.0\n"));
    const Outcome outcome = runTalus({"run", scenario, "--quiet"});
    CHECK(outcome.exit_code == 0);
    CHECK(countOf("no equilibrium at the start", outcome.out) == 1);
    CHECK(countOf("it wets no free block", outcome.out) == 1);
}

}  // namespace talus::tools::testing
