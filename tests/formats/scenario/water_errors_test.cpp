// Faults of [[water]]: a text with one fault, and where it must be found.

#include <algorithm>

#include "faults.h"
#include "talus/simulation.h"

namespace talus::formats {

namespace {

/// `keys` are those of the first water; the first is on line 13.
Fault inWater(const std::string& keys, int line, const std::string& field, const std::string& fragment) {
    return {properties() + stack() + "[[water]]\n" + keys, 11 + line, "water[0]" + field, fragment};
}

}  // namespace

TEST_CASE("scenario errors: water") {
    checkFault(inWater("depth = 1\n", 1, ".fissure", "one of these is required: fissure, between, block"));
    checkFault(inWater("fissure = 1\nblock = \"c1r1s1\"\nface = \"+x\"\ndepth = 1\n", 3, ".block",
                       "found fissure, block together, allowed: exactly one of fissure, between, block"));
    checkFault(inWater("fissure = 1\n", 1, ".depth", "one of these is required: depth, elevation, levels"));
    checkFault(inWater("fissure = 1\ndepth = 0.1\nelevation = 0.1\n", 4, ".elevation",
                       "exactly one of depth, elevation, levels"));
    checkFault(inWater("fissure = 1\ndepth = 0.1\nlevels = [[0, 1]]\n", 4, ".levels", "exactly one of"));
    checkFault(inWater("fissure = 4\ndepth = 0.1\n", 2, ".fissure", "found 4, allowed: 0 to 3"));
    checkFault(inWater("fissure = -1\ndepth = 0.1\n", 2, ".fissure", "found -1, allowed: 0 to 3"));
    checkFault(
        inWater("fissure = 1.0\ndepth = 0.1\n", 2, ".fissure", "found a number 1.0, allowed: an integer"));
    checkFault(inWater("fissure = 1\ndepth = -0.1\n", 3, ".depth", "found -0.1, allowed: at least 0"));
    checkFault(inWater("fissure = 1\ndepth = nan\n", 3, ".depth", "a finite number"));
    checkFault(inWater("fissure = 1\nelevation = inf\n", 3, ".elevation", "a finite number"));
    checkFault(inWater("fissure = 1\ndepth = 0.1\nbase = -0.1\n", 4, ".base", "at least 0"));
    checkFault(inWater("fissure = 1\ndepth = 0.1\nbase = 0.1\n", 4, ".base",
                       "found 0.1, allowed: less than the height of the joint's walls, 0.1"));
    checkFault(inWater("fissure = 1\ndepth = 0.1\ndensity = 0\n", 4, ".density", "at least 1 and"));
    checkFault(inWater("fissure = 1\ndepth = 0.1\ndrains_at_aperture = 0\n", 4, ".drains_at_aperture",
                       "greater than 0"));
    checkFault(inWater("fissure = 1\ndepth = 0.1\ndrains_at_aperture = inf\n", 4, ".drains_at_aperture",
                       "a finite number"));
    checkFault(inWater("fissure = 1\nhead = [1, 1]\ndepth = 1\n", 3, ".head", "found head without between"));
    checkFault(inWater("fissure = 1\nface = \"+x\"\ndepth = 1\n", 3, ".face", "found face without block"));
    checkFault(inWater("fissure = 1\nstack = \"b\"\ndepth = 1\n", 3, ".stack", "unknown stack \"b\""));
    checkFault(inWater("fissure = 1\nlevels = []\n", 3, ".levels", "found an empty array"));
    checkFault(inWater("fissure = 1\nlevels = [[0, 0.1], [1]]\n", 3, ".levels[1]", "an array of 2 numbers"));
    checkFault(inWater("fissure = 1\nlevels = [[0, 0.1],\n[0, 0.2]]\n", 4, ".levels[1]",
                       "found the time 0, allowed: greater than the one before, 0"));
    checkFault(inWater("fissure = 1\nlevels = [[0, -0.1]]\n", 3, ".levels[0][1]", "at least 0"));
    checkFault(inWater("fissure = 1\nelevation = 0.1\nelevations = [[0, 1]]\n", 4, ".elevations",
                       "exactly one of depth, elevation, levels, elevations"));
    checkFault(inWater("fissure = 1\nelevations = [[0, 2e6]]\n", 3, ".elevations[0][1]", "found 2000000"));
    checkFault(inWater("fissure = 1\nlevels = [3]\n", 3, ".levels[0]",
                       "found an integer 3, allowed: an array of 2 numbers"));

    checkFault(inWater("between = [\"c1r1s1\", \"c1r2s1\"]\n", 1, ".depth",
                       "one of these is required: depth, elevation, levels, elevations, head"));
    checkFault(
        inWater("between = [\"c1r1s1\", \"c1r2s1\"]\nhead = [1]\n", 3, ".head", "an array of 2 numbers"));
    checkFault(inWater("between = [\"c1r1s1\", \"c1r2s1\"]\nhead = [1, -1]\n", 3, ".head[1]", "at least 0"));
    checkFault(inWater("between = [\"c1r1s1\", \"c1r2s1\"]\nhead = [1, 1]\nbase = 0.1\n", 4, ".base",
                       "found base without fissure"));
    checkFault(inWater("between = [\"c1r1s1\", \"c1r9s1\"]\nhead = [1, 1]\n", 2, ".between[1]",
                       "unknown block \"c1r9s1\""));
    checkFault(inWater("block = \"c1r1s1\"\ndepth = 1\n", 1, ".face", "missing"));
    checkFault(inWater("block = \"c1r1s1\"\nface = \"x\"\ndepth = 1\n", 3, ".face",
                       "found \"x\", allowed: \"+x\", \"-x\", \"+y\""));
    checkFault(inWater("block = \"key\"\nface = \"+x\"\ndepth = 1\n", 2, ".block", "unknown block \"key\""));

    const std::string water = "[[water]]\nfissure = 1\ndepth = 0.1\n";
    checkFault({properties() + block("a") + water, 11, "water[0].fissure",
                "a fissure in a scenario without a [[stack]]"});
    checkFault({properties() + stack("bond = \"running\"\n") + water, 14, "water[0].fissure",
                "with running bond, allowed: bond \"stack\" only"});
    checkFault({properties() + stack("name = \"a\"\n") + stack("name = \"b\"\norigin = [0, 9, 0]\n") + water,
                20, "water[0].stack", "missing; required because there are several stacks, allowed: a, b"});
    checkFault({"water = 3\n" + properties() + stack(), 1, "water",
                "found an integer 3, allowed: tables that begin with [[water]]"});
    checkFault({"[material]\n" + joint() + stack(), 1, "material", "missing; required: [material.NAME]"});
    checkFault({"joint = {}\n" + material() + stack(), 1, "joint", "missing; required: [joint.default]"});
}

TEST_CASE("scenario errors: closed volumes of water") {
    const std::string closed = "fissure = 1\ndepth = 0.05\nvolume = \"closed\"\n";
    checkFault(inWater(closed, 1, ".opening", "missing"));
    checkFault(inWater(closed + "opening = 0\n", 5, ".opening", "found 0, allowed: greater than 0"));
    checkFault(inWater("fissure = 1\ndepth = 0.05\nvolume = \"open\"\n", 4, ".volume",
                       "found \"open\", allowed: \"held\", \"closed\""));
    for (const std::string key :
         {"opening", "inflow", "overflow", "rain", "catchment", "leak_aperture", "leak_length"})
        for (const std::string held : {"", "volume = \"held\"\n"})
            checkFault(inWater("fissure = 1\ndepth = 0.05\n" + key + " = 0.008\n" + held, 4, "." + key,
                               "found " + key + " without volume = \"closed\", allowed: only with it"));
    const std::string good = closed + "opening = 0.002\n";
    checkFault(inWater(good + "inflow = -1\n", 6, ".inflow", "found -1, allowed: at least 0"));
    checkFault(inWater(good + "inflow = \"rain\"\n", 6, ".inflow", "found a string \"rain\""));
    checkFault(inWater(good + "inflow = []\n", 6, ".inflow",
                       "found an empty array, allowed: [[time s, m3/s per m], ...]"));
    checkFault(inWater(good + "inflow = [[0, 1], [0, 2]]\n", 6, ".inflow[1]", "found the time 0"));
    checkFault(inWater(good + "rain = 10\n", 6, ".rain",
                       "found rain without catchment, allowed: only together with catchment"));
    checkFault(inWater(good + "catchment = 10\n", 6, ".catchment", "found catchment without rain"));
    checkFault(inWater(good + "leak_aperture = 1e-4\n", 6, ".leak_aperture",
                       "found leak_aperture without leak_length, allowed: only together with leak_length"));
    checkFault(inWater(good + "leak_length = 5\n", 6, ".leak_length", "found leak_length without"));
    const std::string slope = good + "catchment = 10\n";
    checkFault(inWater(slope + "rain = -1\n", 7, ".rain", "found -1, allowed: at least 0"));
    checkFault(inWater(slope + "rain = [[0, 5], [60, 4000]]\n", 7, ".rain[1][1]", "found 4000, allowed"));
    checkFault(inWater(slope + "rain = [[0, 5], [0, 6]]\n", 7, ".rain[1]", "found the time 0"));
    checkFault(
        inWater(good + "leak_length = 5\nleak_aperture = 0.1\n", 7, ".leak_aperture", "found 0.1, allowed"));
    checkFault(
        inWater(good + "overflow = 0.04\n", 6, ".overflow", "found 0.04, allowed: at least the depth, 0.05"));
    checkFault(inWater(good + "drains_at_aperture = 0.001\n", 6, ".drains_at_aperture",
                       "found drains_at_aperture beside volume = \"closed\", allowed: fissure or joint"));
    const std::string end = "volume = \"closed\"\nopening = 0.002\n";
    checkFault(inWater("fissure = 1\nlevels = [[0, 0.05]]\n" + end, 3, ".levels", "found levels beside"));
    checkFault(inWater("fissure = 1\nelevations = [[0, 0.05]]\n" + end, 3, ".elevations",
                       "found elevations beside"));
    checkFault(inWater("between = [\"c1r1s1\", \"c2r1s1\"]\ndepth = 0.05\n" + end, 2, ".between",
                       "found between beside volume = \"closed\""));
    checkFault(inWater("block = \"c1r1s1\"\nface = \"+x\"\ndepth = 0.05\n" + end, 2, ".block",
                       "found block beside volume = \"closed\""));
}

TEST_CASE("scenario errors: a closed volume in a fissure that is not bounded is found by the engine") {
    const auto faultOf = [](const std::string& stack_keys, const std::string& keys) {
        const Scenario scenario = readGood(properties() + stack(stack_keys) + "[[water]]\n" + keys +
                                           "volume = \"closed\"\nopening = 0.002\n");
        const auto errors = placed(scenario, checkModel(scenario.model));
        CAPTURE(all(errors));
        REQUIRE(errors.size() == 1);
        CHECK(errors[0].field == "water[0].volume");
        CHECK(errors[0].line > 0);
        return errors[0].message;
    };
    for (const char* free_face : {"fissure = 0\ndepth = 0.05\n", "fissure = 3\ndepth = 0.05\n"})
        CHECK(faultOf("", free_face).find("found a fissure that is not bounded") != std::string::npos);
    CHECK(faultOf("heights = [1, 2, 2]\n", "fissure = 1\ndepth = 0.08\n").find("below the level") !=
          std::string::npos);
}

TEST_CASE(
    "scenario errors: water that overlaps other water is found by the engine, and has its place in the "
    "file") {
    const auto faultsOf = [](const std::string& text) {
        const Scenario scenario = readGood(text);
        return placed(scenario, checkModel(scenario.model));
    };
    const auto two = [](const std::string& first, const std::string& second) {
        return properties() + stack() + "[[water]]\n" + first + "[[water]]\n" + second;
    };
    const auto overlaps = [&](const std::string& first, const std::string& second) {
        const auto errors = faultsOf(two(first, second));
        CAPTURE(all(errors));
        REQUIRE(errors.size() == 1);
        CHECK(errors[0].field == "water[1]");
        CHECK(errors[0].line == 12 + 1 + std::count(first.begin(), first.end(), '\n'));
        CHECK(errors[0].message.find("overlaps that of water[0]") != std::string::npos);
    };
    const auto fits = [&](const std::string& first, const std::string& second) {
        const auto errors = faultsOf(two(first, second));
        CAPTURE(all(errors));
        CHECK(errors.empty());
    };
    overlaps("fissure = 1\ndepth = 0.05\n", "fissure = 1\ndepth = 0.02\n");
    overlaps("fissure = 1\ndepth = 0.05\n", "fissure = 1\ndepth = 0.02\nbase = 0.04\n");
    overlaps("fissure = 1\ndepth = 0.02\nbase = 0.04\n", "fissure = 1\ndepth = 0.05\n");
    overlaps("fissure = 1\ndepth = 0.05\n", "fissure = 1\nelevation = 0.02\n");
    overlaps("fissure = 1\nlevels = [[0, 0.0], [1, 0.06]]\n", "fissure = 1\ndepth = 0.02\nbase = 0.05\n");
    overlaps("fissure = 1\ndepth = 0.05\n", "block = \"c1r1s1\"\nface = \"+x\"\ndepth = 0.01\n");
    // The wet part that overlaps is found wherever it stands among many, and named by its place in the file.
    for (const int at : {1, 7, 24}) {
        std::string many = properties() + stack();
        for (int k = 0; k < 25; ++k)
            many += "[[water]]\nfissure = 1\nbase = " + std::to_string(0.001 * (k == 24 ? at - 1 : k + 1)) +
                    "\ndepth = 0.0009\n";
        const auto errors = faultsOf(many);
        REQUIRE(errors.size() == (at == 1 ? 0 : 1));
        if (at == 1) continue;
        CHECK(errors[0].field == "water[24]");
        CHECK(errors[0].message.find("overlaps that of water[" + std::to_string(at - 2) + "]") !=
              std::string::npos);
    }
    fits("fissure = 1\ndepth = 0.05\n", "fissure = 1\ndepth = 0.02\nbase = 0.05\n");
    fits("fissure = 1\ndepth = 0.05\n", "fissure = 2\ndepth = 0.05\n");
    fits("fissure = 1\ndepth = 0.05\n", "fissure = 1\ndepth = 0.0\n");
    fits("fissure = 1\ndepth = 0.05\n", "fissure = 1\nelevation = -0.02\n");
    fits("fissure = 1\ndepth = 0.05\n", "block = \"c1r1s1\"\nface = \"-x\"\ndepth = 0.01\n");
    fits("fissure = 1\ndepth = 0.05\n", "block = \"c1r2s1\"\nface = \"+x\"\ndepth = 0.01\n");

    // At 30 deg the level at elevation 0.12 stands at (0.12 - 0.2 sin 30) / cos 30 = 0.0231 on the plane x =
    // 0.2.
    const std::string tilt = "[gravity]\ntilt_deg = 30\n";
    const std::string low = "fissure = 1\nelevation = 0.12\n";
    CHECK(faultsOf(tilt + two(low, "fissure = 1\ndepth = 0.02\nbase = 0.0232\n")).empty());
    CHECK(faultsOf(tilt + two(low, "fissure = 1\ndepth = 0.02\nbase = 0.0230\n")).at(0).field == "water[1]");
    // A search starts at analysis.start_deg.
    CHECK(faultsOf("[analysis]\nstart_deg = 0\n" + tilt +
                   two(low, "fissure = 1\ndepth = 0.02\nbase = 0.0232\n"))
              .size() == 1);
}

}  // namespace talus::formats
