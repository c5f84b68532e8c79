// Lines that fit a terminal, and progress shown on it.

#include "cli/terminal.h"

#include <doctest/doctest.h>

#include "tools/program.h"
#include "tools/terminal.h"

using namespace talus;
using namespace talus::tools;
using namespace talus::tools::testing;

TEST_CASE("long lines are broken at spaces and continue behind their label; short ones stay as they are") {
    CHECK(fitted("moving blocks     1: key\nanother\n", 50) == "moving blocks     1: key\nanother\n");
    CHECK(fitted("range             none: weight brought on at that load fails in the same place\n", 50) ==
          "range             none: weight brought on at that\n"
          "                  load fails in the same place\n");
    CHECK(fitted("                  one two three four five", 40) ==
          "                  one two three four\n                  five");
    CHECK(fitted("warning: what is longer than that", 20) == "warning: what is\n  longer than that");
    CHECK(fitted("a/path/that/is/longer/than/the/terminal", 20) == "a/path/that/is/longer/than/the/terminal");
    CHECK(fitted("", 20).empty());
}

TEST_CASE("a terminal gets results that fit it, a pipe gets lines") {
    const TemporaryFolder folder;
    const std::string path = folder.write("slides.toml", blockScenario(10, 20));
    const std::vector<std::string> arguments{"safety-factor", path, "--threads", "1"};
    const std::string shown = shownOnTerminal(arguments, 50);
    REQUIRE(shown.find("state hash") != std::string::npos);
    for (const std::string& line : plainLines(shown)) {
        CAPTURE(line);
        CHECK((line.size() <= 50 || line.find(path) != std::string::npos));
    }
    CHECK(runTalus(arguments).out.find("\ntheory            tan phi / tan alpha") == std::string::npos);
}

TEST_CASE("a terminal shows that blocks are cut and contacts searched for") {
    const TemporaryFolder folder;
    const std::string path = folder.write(
        "cut.toml",
        "[material.rock]\ndensity = 2600.0\n[joint.default]\nfriction_deg = 35.0\nnormal_stiffness = 1e10\n"
        "shear_stiffness = 1e9\n[rock_mass]\nregion = { box = { min = [0, 0, 0], max = [9, 9, 9] } }\n"
        "fixed = [{ boundary = \"-z\" }]\n"
        "[[joint_set]]\ndip_deg = 20\ndip_direction_deg = 270\nspacing = 1.0\n"
        "[[joint_set]]\ndip_deg = 85\ndip_direction_deg = 90\nspacing = 1.0\n"
        "[[joint_set]]\ndip_deg = 88\ndip_direction_deg = 0\nspacing = 1.0\n");
    const std::string shown = shownOnTerminal({"validate", path}, 100);
    CHECK(shown.find("cutting") != std::string::npos);
    CHECK(shown.find("shaping") != std::string::npos);
    CHECK(shown.find("contacts") != std::string::npos);
    CHECK(runTalus({"validate", path}).err.find("cutting") == std::string::npos);
}
