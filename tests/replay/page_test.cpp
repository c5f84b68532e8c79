// The replay page in a browser: page.test.mjs opens it in headless Chromium.

#include <doctest/doctest.h>

#include "support/browser.h"
#include "support/skip.h"
#include "support/snapshots.h"
#include "tools/program.h"

using namespace talus::tools::testing;

namespace {

/// The laboratory slope with soft joints, steep enough to fail within half a second.
std::string slopeText() {
    return "[run]\nduration_s = 0.4\nframe_interval_s = 0.01\n[gravity]\ntilt_deg = 19.0\n[damping]\n"
           "contact = 1e-5\n[material.granite]\ndensity = 2700.0\n[joint.default]\nnormal_stiffness = 1e8\n"
           "shear_stiffness = 1e8\nfriction_deg = 19.5\n[[stack]]\ncolumns = 7\nrows = 5\nslices = 3\n"
           "block = [0.2, 0.1, 0.1]\n[[water]]\nfissure = 5\ndepth = 0.35\n";
}

/// Two rocks that are thrown on a slope far larger than they are.
std::string rockfallText() {
    return "[run]\nduration_s = 1.6\nframe_interval_s = 0.02\n[damping]\ncontact = 1e-5\n[material.granite]\n"
           "density = 2700.0\n[joint.default]\nnormal_stiffness = 1e8\nshear_stiffness = 1e8\n"
           "friction_deg = 30\n[[block]]\nname = \"slope\"\nfixed = true\nvertices = [[0, 0, 0], [40, 0, 0], "
           "[0, 30, 0], [40, 30, 0], [40, 0, 30], [40, 30, 30]]\n[[block]]\nname = \"rock\"\nbox = { min = "
           "[30, "
           "15, 24], max = [31, 16, 25] }\n[[block]]\nname = \"second\"\nbox = { min = [26, 12, 21], max = "
           "[26.8, 12.9, 22] }\n";
}

/// Two rocks that go down a slope of a hundred times their size and beyond it.
std::string farRockfallText() {
    return "[run]\nduration_s = 5.0\nframe_interval_s = 0.05\n[damping]\ncontact = 1e-5\n[material.granite]\n"
           "density = 2700.0\n[joint.default]\nnormal_stiffness = 1e8\nshear_stiffness = 1e8\n"
           "friction_deg = 30\n[[block]]\nname = \"slope\"\nfixed = true\nvertices = [[0, 0, 0], [40, 0, 0], "
           "[0, 30, 0], [40, 30, 0], [40, 0, 30], [40, 30, 30]]\n[[block]]\nname = \"rock\"\nbox = { min = "
           "[37, 15, 36], max = [37.6, 15.7, 36.8] }\n[[block]]\nname = \"second\"\nbox = { min = [38, 12, "
           "40], max = [38.5, 12.5, 40.4] }\n";
}

/// Two blocks on a plane that tilts by 25 degrees, one rougher than the other.
std::string unequalText() {
    return "[gravity]\ntilt_deg = 25.0\n[material.rock]\ndensity = 2600.0\n"
           "[joint.default]\nnormal_stiffness = 1e11\nshear_stiffness = 1e10\nfriction_deg = 30.0\n"
           "[joint.rough]\nnormal_stiffness = 1e11\nshear_stiffness = 1e10\nfriction_deg = 40.0\n"
           "[[block]]\nname = \"floor\"\nfixed = true\nbox = { min = [-2, 0, -1], max = [6, 1, 0] }\n"
           "[[block]]\nname = \"low\"\nbox = { min = [-1, 0, 0], max = [0, 1, 0.2] }\n"
           "[[block]]\nname = \"high\"\nbox = { min = [3, 0, 0], max = [4, 1, 0.2] }\n"
           "[[interface]]\nbetween = [\"floor\", \"high\"]\njoint = \"rough\"\n";
}

/// A box on the floor, with flow in the joint below it from 2 m of head to the level of the joint.
std::string seepageText(bool flows) {
    const std::string flow =
        "[flow]\naperture = 1e-4\nfree_surface = false\n[[flow.boundary]]\nface = \"-x\"\nhead = 0.0\n"
        "[[flow.boundary]]\nface = \"+x\"\nhead = 2.0\n";
    return "[run]\nduration_s = 0.02\nframe_interval_s = 0.005\n[material.rock]\ndensity = 2600.0\n"
           "[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 30.0\n"
           "[[block]]\nname = \"floor\"\nfixed = true\nbox = { min = [-3, -2, -1], max = [5, 4, 0] }\n"
           "[[block]]\nname = \"box\"\nbox = { min = [0, 0, 0], max = [2, 2, 1] }\n" +
           (flows ? flow : "");
}

/// A block that slides on a plane of 40 degrees where its friction is less.
std::string mappedText() {
    return "[material.rock]\ndensity = 2600.0\n[joint.default]\nnormal_stiffness = 1e10\n"
           "shear_stiffness = 1e10\nfriction_deg = 43.0\n[rock_mass]\nregion = { profile = [[-2, -1], [12, "
           "-1], [12, 10], [5, 10], [0, 0], [-2, 0]], y = [0, 4] }\nfixed = [{ boundary = \"-z\" }]\n"
           "[[single_joint]]\npoint = [2.0, 0.0, 4.0]\ndip_deg = 40.0\ndip_direction_deg = 270.0\n";
}

/// What a script finds in a page.
void lookIn(const std::string& script, const std::string& page, const std::string& word, int tests) {
    const ScriptOutcome seen = runScript(script, "'" + page + "' \"$CHROMIUM\" " + word);
    if (seen.is_skipped)
        return talus::test::skip("node, npm, chromium or playwright-core are not to be had here");
    INFO(seen.said);
    CHECK(seen.status == 0);
    CHECK(seen.said.find(std::to_string(tests) + " passed, 0 failed") != std::string::npos);
}

/// What a script finds in the page of what a command writes.
void lookAt(const std::string& script, const std::string& scenario, const std::vector<std::string>& command,
            const std::string& option, const std::string& word, int tests) {
    const TemporaryFolder folder;
    const std::string run = folder / "slope.mcap", page = folder / "slope.html";
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.begin() + 1, folder.write("slope.toml", scenario));
    arguments.insert(arguments.end(), {option, run, "--quiet"});
    REQUIRE(runTalus(arguments).exit_code == 0);
    REQUIRE(runTalus({"replay", run, "-o", page}).exit_code == 0);
    lookIn(script, page, word, tests);
}

/// In that of a scenario's run.
void look(const std::string& script, const std::string& scenario, const std::string& word, int tests) {
    lookAt(script, scenario, {"run"}, "-o", word, tests);
}

}  // namespace

TEST_SUITE("slow: replay page") {
    TEST_CASE("the page shows the groups of a factor of safety, and the mechanism of a limit analysis") {
        SUBCASE("groups") {
            lookAt("replay/kept.test.mjs", unequalText(), {"safety-factor", "--groups", "3"}, "--keep-run",
                   "groups", 4);
        }
        SUBCASE("mechanism") {
            lookAt("replay/kept.test.mjs", unequalText(), {"limit-analysis", "--for", "factor"},
                   "--keep-mechanism", "mechanism", 4);
        }
    }

    TEST_CASE("the page colours joints by the pressure of flow, where a scenario has it") {
        SUBCASE("flow") { look("replay/flow.test.mjs", seepageText(true), "flow", 4); }
        SUBCASE("none") { look("replay/flow.test.mjs", seepageText(false), "none", 4); }
    }

    TEST_CASE("the map of a batch stands on the slope, and its cells tell their numbers") {
        const TemporaryFolder folder;
        folder.write("slope.toml", mappedText());
        const std::string page = folder / "map.html",
                          sweep = folder.write("sweep.toml",
                                               "scenario = \"slope.toml\"\nanalysis = \"safety-factor\"\n"
                                               "samples = 12\n[[random]]\nfield = "
                                               "\"joint.default.friction_deg\"\ndistribution = \"uniform\"\n"
                                               "min = 30.0\nmax = 50.0\n");
        REQUIRE(runTalus({"batch", sweep, "-o", folder / "out", "--map-3d", page, "--quiet"}).exit_code == 0);
        lookIn("replay/map.test.mjs", page, "", 4);
    }

    TEST_CASE("the page plays, seeks, picks and tells why in headless Chromium") {
        look("replay/page.test.mjs", slopeText(), "", 9);
    }

    TEST_CASE("the page frames what moves beside its legends, and says why by the numbers that decide") {
        SUBCASE("a slope of blocks") { look("replay/framing.test.mjs", slopeText(), "", 6); }
        SUBCASE("a rockfall") { look("replay/framing.test.mjs", rockfallText(), "", 6); }
        SUBCASE("a rockfall that goes far") { look("replay/framing.test.mjs", farRockfallText(), "", 6); }
    }

    TEST_CASE("the page opens on what moves, cuts sections, shows ways, saves pictures and films") {
        SUBCASE("a slope of blocks") { look("replay/views.test.mjs", slopeText(), "toppling", 5); }
        SUBCASE("a rockfall") { look("replay/views.test.mjs", rockfallText(), "falling", 5); }
    }
}
