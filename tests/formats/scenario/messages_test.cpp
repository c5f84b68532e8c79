// Messages as a user reads them, several at once, places, and files that are no scenarios.

#include <cstdio>

#include "scenario_texts.h"
#include "support/cpu_time.h"
#include "support/files.h"
#include "toml/wording.h"

namespace talus::formats {

namespace {

using test::TemporaryFile;

std::string repeated(const std::string& text, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
}

}  // namespace

TEST_CASE("scenario messages: the format") {
    CHECK(format({"stack[0].columns", "found 0, allowed: 1 to 9", "a.toml", 3, 11}) ==
          "a.toml:3:11: error: stack[0].columns: found 0, allowed: 1 to 9");
    CHECK(format({"stack[0]", "bad", "a.toml", 3, 0}) == "a.toml:3: error: stack[0]: bad");
    CHECK(format({"stack[0]", "bad", "a.toml", 0, 0}) == "a.toml: error: stack[0]: bad");
    CHECK(format({"", "cannot be opened", "a.toml", 0, 0}) == "a.toml: error: cannot be opened");
    CHECK(format({"stack", "bad"}) == "error: stack: bad");
}

TEST_CASE(
    "scenario messages: line and column of the value, of the key if that is unknown, of the table if it "
    "lacks one") {
    const auto errors = readBad(properties() + "  [[stack]]\n  columns =   0\n rwos = 5\nslices = 2\n");
    REQUIRE(errors.size() == 3);
    CHECK(format(errors[0]) == "bad.toml:7:3: error: stack[0].block: missing; this key is required");
    CHECK(format(errors[1]) == "bad.toml:8:15: error: stack[0].columns: found 0, allowed: 1 to 1000000");
    CHECK(format(errors[2]) ==
          "bad.toml:9:2: error: stack[0].rwos: found an unknown key \"rwos\", did you mean \"rows\"?");
}

TEST_CASE("scenario messages: all faults at once, in the order of the file") {
    const auto errors = readBad(
        "[gravity]\ntilt_deg = 91\n[joint.default]\nnormal_stiffness = 0\nshear_stiffness = \"x\"\n"
        "[material.granite]\ndensity = -1\n[[stack]]\ncolumns = 2\nrows = 1\nslices = 1\nblock = [1, 0, "
        "nan]\n"
        "joint = \"x\"\n[[water]]\nfissure = 3\ndepth = -1\n[[interface]]\nbetween = [\"c1r1s1\", "
        "\"c9r1s1\"]\n"
        "joint = \"y\"\n[run]\nwatch = [\"nobody\"]\n");
    const std::vector<std::pair<int, std::string>> expected = {{2, "gravity.tilt_deg"},
                                                               {3, "joint.default.friction_deg"},
                                                               {4, "joint.default.normal_stiffness"},
                                                               {5, "joint.default.shear_stiffness"},
                                                               {7, "material.granite.density"},
                                                               {12, "stack[0].block[1]"},
                                                               {12, "stack[0].block[2]"},
                                                               {13, "stack[0].joint"},
                                                               {15, "water[0].fissure"},
                                                               {16, "water[0].depth"},
                                                               {18, "interface[0].between[1]"},
                                                               {19, "interface[0].joint"},
                                                               {21, "run.watch[0]"}};
    CAPTURE(all(errors));
    REQUIRE(errors.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CHECK(errors[i].line == expected[i].first);
        CHECK(errors[i].field == expected[i].second);
    }
}

TEST_CASE("scenario messages: unknown blocks are not reported while names are unknown") {
    const auto errors = readBad(properties() + stack("", "columns = 0\nrows = 1\nslices = 1\n") +
                                "[run]\nwatch = [\"c9r1s1\"]\n");
    CHECK(errors.size() == 1);
}

TEST_CASE("scenario messages: fifty are shown, the others counted") {
    const auto errors =
        readBad(properties() + stack() + repeated("[[water]]\nfissure = 1\ndepth = -1\n", 2000));
    REQUIRE(errors.size() == 51);
    CHECK(errors[49].field == "water[49].depth");
    CHECK(format(errors[50]) == "bad.toml: error: and 1950 further errors");
}

TEST_CASE("scenario messages: syntax errors carry their place") {
    const auto syntax = [](const std::string& text, int line) {
        const auto errors = readBad(text);
        REQUIRE(errors.size() == 1);
        CAPTURE(format(errors[0]));
        CHECK(errors[0].line == line);
        CHECK(errors[0].column >= 1);
        CHECK(errors[0].message.find("not valid TOML") != std::string::npos);
    };
    syntax("[gravity]\ntilt_deg = \n", 2);
    syntax("[gravity]\ntilt_deg = 3\ntilt_deg = 4\n", 3);
    syntax("[gravity\n", 1);
    syntax("a = 1\nb = [1,\n", 2);
    syntax("a = 1\nb = \"open\n", 2);
    syntax("a = 1\n\nb = \"\xff\xfe\"\n", 3);
    syntax("a = 999999999999999999999999\n", 1);
    syntax(std::string("a = 1\n\0", 7), 2);
    syntax("\x89PNG\r\n", 1);
    const auto errors = readBad("a = tru\n'\n");
    CHECK(errors.at(0).message.find('\n') == std::string::npos);
}

TEST_CASE("scenario messages: nothing to compute") {
    for (const char* text : {"", "\n\n", "# nothing\n", "format = 1\n", "stack = []\nblock = []\n"}) {
        const auto errors = readBad(text);
        REQUIRE(errors.size() == 1);
        CHECK(errors[0].field == "stack");
        CHECK(errors[0].line == 1);
        CHECK(errors[0].message.find("no blocks") != std::string::npos);
    }
}

TEST_CASE("scenario messages: places of fields, and errors of the engine put there") {
    const Scenario scenario = readGood(properties() + stack() + "[[water]]\nfissure = 1\ndepth = 0.1\n" +
                                       block("key") + "[gravity]\ntilt_deg = 3\n");
    using Place = std::pair<int, int>;
    CHECK(scenario.path == "good.toml");
    CHECK(scenario.text.substr(0, 10) == "[material.");
    CHECK(scenario.places.at("material.granite") == Place(1, 1));
    CHECK(scenario.places.at("material.granite.density") == Place(2, 11));
    CHECK(scenario.places.at("stack[0]") == Place(7, 1));
    CHECK(scenario.places.at("stack[0].columns") == Place(8, 11));
    CHECK(scenario.places.at("stack[0].block") == Place(11, 9));
    CHECK(scenario.places.at("water[0].depth") == Place(14, 9));
    CHECK(scenario.places.at("block[0].box.min").first == 17);
    CHECK(scenario.places.at("gravity.tilt_deg") == Place(19, 12));

    const auto errors = placed(scenario, {{"water[0].walls", "a"},
                                          {"water[0].depth", "b"},
                                          {"block[0].box.min.x", "c"},
                                          {"interface[7]", "d"},
                                          {"", "e"},
                                          {"stack[0]", "f", "other.toml", 99, 1}});
    CHECK(format(errors[0]) == "good.toml:12:1: error: water[0].walls: a");
    CHECK(format(errors[1]) == "good.toml:14:9: error: water[0].depth: b");
    CHECK(errors[2].line == 17);
    CHECK(format(errors[3]) == "good.toml: error: interface[7]: d");
    CHECK(format(errors[4]) == "good.toml: error: e");
    CHECK(format(errors[5]) == "other.toml:99:1: error: stack[0]: f");
}

TEST_CASE("scenario files: read, missing, a folder, no scenario, too large") {
    const TemporaryFile good("slope.toml", properties() + stack());
    const auto scenario = readScenario(good.path());
    REQUIRE(scenario.ok());
    CHECK(scenario->path == good.path());
    CHECK(scenario->model.blocks.size() == 13);

    const auto only = [](const std::string& path) {
        const auto failed = readScenario(path);
        REQUIRE(failed.errors().size() == 1);
        CHECK(failed.errors()[0].file == path);
        return failed.errors()[0];
    };
    CHECK(only(good.folder() + "/none.toml").message == "cannot be opened: No such file or directory");
    CHECK(only(good.folder()).message.find("found a directory") == 0);
    CHECK(only("").line == 0);
    const TemporaryFile binary("slope.toml", std::string("\x89MCAP0\r\n\0\xff", 10));
    CHECK(only(binary.path()).message.find("utf-8") != std::string::npos);
    const TemporaryFile large("slope.toml", std::string((std::size_t{64} << 20) + 1, '#'));
    CHECK(only(large.path()).message.find("larger than 64 MiB") != std::string::npos);
}

TEST_CASE("scenario files: line ends of other systems, a byte order mark") {
    std::string text = properties() + stack();
    std::string dos;
    for (const char c : text) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
    CHECK(readGood(dos).places.at("stack[0].block") == std::pair<int, int>(11, 9));
    CHECK(readGood("\xEF\xBB\xBF" + text).model.blocks.size() == 13);
}

TEST_CASE("scenario files: hostile texts end in errors, soon") {
    const double start = test::cpuSeconds();
    readBad(repeated("a.", 1000000) + "b = 1\n");
    readBad("[" + repeated("a.", 1000000) + "b]\n");
    readBad("x = " + repeated("[", 1000000));
    readBad("x = " + repeated("[", 100) + repeated("]", 100));
    readBad(repeated("x = { a = ", 1000000));
    readBad("x = [\"\"\"\"a\"\"\"\"\", { " + repeated("a.", 100000) + "b = 1 } ]\n");
    readBad("x = ['''a'''', { " + repeated("a.", 100000) + "b = 1 } ]\n");
    readBad("x = \"\\\"\" # \"\n" + repeated("a.", 100000) + "b = 1\n");
    readBad(repeated("x", 1000000) + " = 1\n");
    readBad("\"" + repeated("\\u0001", 10000) + "\" = 1\n");
    // Each level as deep as it may be: tables are taken down recursively.
    std::string nested = "x = ";
    for (int level = 0; level < 250; ++level) nested += "{ " + repeated("a.", 15) + "a = ";
    readBad(nested + "1" + repeated(" }", 250) + "\n");
    // Many large stacks, many waters on many walls, many unknown names: stopped before memory or time run
    // out.
    std::string stacks;
    for (int i = 0; i < 100; ++i)
        stacks +=
            stack("name = \"s" + std::to_string(i) + "\"\n", "columns = 1000000\nrows = 1\nslices = 1\n");
    readBad(properties() + stacks);
    readBad(properties() + stack("", "columns = 1\nrows = 20000\nslices = 1\n") +
            repeated("[[water]]\nfissure = 1\ndepth = 0\n", 1000));
    readBad(properties() + stack("", "columns = 100\nrows = 100\nslices = 1\n") +
            repeated("[[interface]]\nbetween = [\"nobody\", \"no one\"]\njoint = \"none\"\n", 20000));
    CHECK(test::cpuSeconds() - start < 60);
}

TEST_CASE("scenario files: dots that are no deep keys") {
    readGood("# " + repeated(".", 100) + "\n" + properties() +
             stack("name = \"" + repeated(".", 50) + "\"\n"));
    readGood("# \"\n" + properties() + stack("name = '''\"" + repeated(".", 50) + "'''\n"));
}

TEST_CASE("scenario messages: near words") {
    using toml::nearest;
    const std::vector<std::string> keys = {"columns", "rows", "friction_deg", "duration_s"};
    CHECK(nearest("colunms", keys) == "columns");
    CHECK(nearest("COLUMNS", keys) == "columns");
    CHECK(nearest("row", keys) == "rows");
    CHECK(nearest("friction", keys) == "friction_deg");
    CHECK(nearest("fricton", keys) == "friction_deg");
    CHECK(nearest("duraton", keys) == "duration_s");
    CHECK_FALSE(nearest("slices", keys).has_value());
    CHECK_FALSE(nearest("", keys).has_value());
    CHECK(toml::quoted("a\nb\x7f") == "\"a?b?\"");
    CHECK(toml::quoted(repeated("\xC3\xA4", 100)) == "\"" + repeated("\xC3\xA4", 30) + "...\"");
    CHECK(toml::quoted("x" + repeated("\xC3\xA4", 100)) == "\"x" + repeated("\xC3\xA4", 29) + "...\"");
    CHECK(toml::numberText(2e6) == "2000000");
    CHECK(toml::numberText(-0.5) == "-0.5");
    CHECK(toml::numberText(3.375e11) == "3.375e+11");
    CHECK(toml::numberText(1e-9) == "1e-09");
}

TEST_CASE("scenario messages: joints and materials that nothing has are warned of") {
    const auto warningsOf = [](const std::string& text) { return readGood(text).warnings; };
    CHECK(warningsOf(properties() + stack()).empty());
    CHECK(warningsOf(properties() + joint("bed") + stack("joint = \"bed\"\n")).empty());
    const auto misspelt =
        warningsOf(properties() + joint("Bed") + block("bed") + stack("origin = [5, 0, 0]\n"));
    REQUIRE(misspelt.size() == 1);
    CHECK(misspelt[0] ==
          "joint.Bed (line 7): nothing in the file uses this joint, so it has no effect, did you mean "
          "\"bed\"?");
    CHECK(warningsOf(joint("wall") + material() + block("one", "joint = \"wall\"\n")).empty());
    const auto spare =
        warningsOf(properties() + "[material.slate]\ndensity = 2600\n" + stack("material = \"granite\"\n"));
    REQUIRE(spare.size() == 1);
    CHECK(spare[0].find("material.slate (line 7): nothing in the file uses this material") == 0);
    // A joint set of the joint's own name, and one that stands for intact rock, have it.
    CHECK(
        warningsOf("[material.rock]\ndensity = 2600\n" + joint("J1") + joint("rock") +
                   "[rock_mass]\nregion = { box = { min = [0, 0, 0], max = [2, 2, 2] } }\nbridge = \"rock\"\n"
                   "joint = \"J1\"\n[[joint_set]]\nname = \"J1\"\ndip_deg = 10\ndip_direction_deg = 270\n"
                   "spacing = 1.0\n")
            .empty());
}

TEST_CASE("scenario messages: a joint that gets stronger as it slips is warned of") {
    for (const std::string more :
         {"friction_deg = 30\ncohesion = 1e3\nresidual_cohesion = 2e3",
          "friction_deg = 30\nresidual_cohesion = 1.0", "friction_deg = 30\nresidual_friction_deg = 30.5"}) {
        CAPTURE(more);
        const auto warnings = readGood(material() + joint("default", more) + stack()).warnings;
        REQUIRE(warnings.size() == 1);
        CHECK(warnings[0].find("the joint gets stronger as it slips") != std::string::npos);
    }
    for (const std::string more : {"friction_deg = 30\ncohesion = 2e3\nresidual_cohesion = 2e3",
                                   "friction_deg = 30\nresidual_friction_deg = 30", "friction_deg = 30"})
        CHECK(readGood(material() + joint("default", more) + stack()).warnings.empty());
}

}  // namespace talus::formats
