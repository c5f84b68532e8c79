// The command line as a whole: help, version, wrong usage, and failures of the file system.

#include <doctest/doctest.h>

#include "tools/program.h"

using namespace talus::tools::testing;

TEST_CASE("help of the program and of every command has an example") {
    const Outcome root = runTalus({"--help"});
    CHECK(root.exit_code == 0);
    CHECK(root.err.empty());
    for (const std::string command :
         {"paper", "critical-angle", "safety-factor", "run", "validate", "theory"}) {
        CAPTURE(command);
        CHECK(root.out.find("  " + command) != std::string::npos);
        const Outcome help = runTalus({command, "--help"});
        CHECK(help.exit_code == 0);
        CHECK(help.out.find("Example") != std::string::npos);
        CHECK(help.out.find("talus " + command) != std::string::npos);
    }
    CHECK(root.out.find("Example") != std::string::npos);
}

TEST_CASE("help of every command fits the terminal") {
    const std::vector<std::string> commands{
        "",          "critical-angle", "safety-factor", "critical-acceleration",
        "run",       "replay",         "inspect",       "export",
        "batch",     "sample",         "merge",         "validate",
        "blocks",    "theory",         "paper",         "limit-analysis",
        "keyblocks", "kinematics",     "verification",  "schema",
        "storm"};
    for (const std::size_t columns : {50, 80, 120}) {
        setenv("COLUMNS", std::to_string(columns).c_str(), 1);
        for (const std::string& command : commands) {
            CAPTURE(command);
            CAPTURE(columns);
            const Outcome help = command.empty() ? runTalus({"--help"}) : runTalus({command, "--help"});
            REQUIRE(help.exit_code == 0);
            std::istringstream lines(help.out);
            for (std::string line; std::getline(lines, line);) {
                const auto first = line.find_first_not_of(' ');
                const bool one_word =
                    first == std::string::npos || line.find(' ', first) == std::string::npos;
                INFO(line);
                CHECK((line.size() <= columns || one_word));
            }
        }
    }
    unsetenv("COLUMNS");
}

TEST_CASE("--set goes with every command that reads a scenario, and the standard input with it") {
    const TemporaryFolder folder;
    const std::string slope = folder.write(
        "slope.toml",
        "[run]\nduration_s = 0.001\n[material.granite]\ndensity = 2700.0\n[joint.default]\nnormal_stiffness "
        "= "
        "1e10\nshear_stiffness = 1e10\nfriction_deg = 30.0\n[[stack]]\ncolumns = 1\nrows = 1\nslices = "
        "1\nblock = [0.2, 0.1, 0.1]\n");
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{"critical-angle"},
                                               {"safety-factor"},
                                               {"critical-acceleration"},
                                               {"limit-analysis", "--for", "tilt"},
                                               {"run"},
                                               {"validate"},
                                               {"blocks"},
                                               {"theory"}}) {
        CAPTURE(command.front());
        std::vector<std::string> arguments = command;
        arguments.insert(arguments.end(), {"--set", "joint.default.friction_deg=95", slope, "--json"});
        const Outcome outcome = runTalus(arguments);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.json().at("errors").at(0).at("file") == "--set");
        CHECK(outcome.json()["errors"][0].at("field") == "joint.default.friction_deg");
    }
    const auto angle = [&](const std::string& friction) {
        return runTalus({"theory", slope, "--set", "joint.default.friction_deg=" + friction, "--json"})
            .json()
            .at("theory_deg")
            .get<double>();
    };
    CHECK(angle("20") == doctest::Approx(20));
    CHECK(angle("25.5") == doctest::Approx(25.5));
    const std::string out = folder / "out";
    CHECK(std::system(("cat '" + slope + "' | '" + TALUS_PROGRAM +
                       "' theory - --set stack[0].columns=2 --json > '" + out + "'")
                          .c_str()) == 0);
    CHECK(nlohmann::json::parse(contentOf(out)).at("theory_deg").get<double>() == doctest::Approx(30));
    CHECK(std::system(
              ("echo 'oops' | '" + std::string(TALUS_PROGRAM) + "' validate - 2> '" + out + "'").c_str()) !=
          0);
    CHECK(contentOf(out).starts_with("stdin:1:"));
    CHECK(runTalus({"validate", slope, "--set", "gravity.tilt_deg"}).exit_code == 2);
    CHECK(runTalus({"run", "--resume", "run.mcap", "--set", "gravity.tilt_deg=3"}).exit_code == 2);
}

TEST_CASE("files are written under names that say what is in them") {
    const TemporaryFolder folder;
    const std::string none = folder / "none";
    const std::vector<std::vector<std::string>> wrong{{"replay", none, "-o", "page.pdf"},
                                                      {"export", none, "--csv", "table.xlsx"},
                                                      {"export", none, "--stl", "last", "-o", "slope.ply"},
                                                      {"export", none, "--ply", "last", "-o", "slope.stl"},
                                                      {"export", none, "--gltf", "run.gltf"},
                                                      {"sample", none, "0", "-o", "run.txt"},
                                                      {"blocks", none, "-o", "slope.png"}};
    for (const auto& arguments : wrong) {
        CAPTURE(arguments.back());
        const Outcome outcome = runTalus(arguments);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.err.find("allowed: a name that ends in") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(arguments.back()));
    }
}

TEST_CASE("version names the build") {
    const Outcome outcome = runTalus({"--version"});
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.out.starts_with("talus "));
    CHECK(outcome.out.find('(') != std::string::npos);
}

TEST_CASE("wrong usage ends with 2, says why, and prints JSON when asked to") {
    const std::vector<std::vector<std::string>> wrong = {
        {"--json"},
        {"criticl-angle", "--json"},
        {"validate", "--json"},
        {"run", "--json", "--no-such-option"},
        {"critical-angle", "slope.toml", "--threads", "-1", "--json"},
        {"critical-angle", "slope.toml", "--threads", "many", "--json"},
    };
    for (const auto& arguments : wrong) {
        CAPTURE(arguments.front());
        const Outcome outcome = runTalus(arguments);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.err.starts_with("error: "));
        const nlohmann::json json = outcome.json();
        CHECK(json.at("ok") == false);
        REQUIRE(json.at("errors").size() == 1);
        CHECK_FALSE(json["errors"][0].at("message").get<std::string>().empty());
    }
}

TEST_CASE("without --json wrong usage leaves stdout empty") {
    const Outcome outcome = runTalus({"theory", "sliding"});
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.find("--length") != std::string::npos);
}

TEST_CASE("an unknown command is answered with the nearest one") {
    CHECK(runTalus({"criticl-angle"}).err.find("did you mean 'critical-angle'?") != std::string::npos);
    CHECK(runTalus({"valid"}).err.find("did you mean 'validate'?") != std::string::npos);
    CHECK(runTalus({"xyzzy-plugh"}).err.find("did you mean") == std::string::npos);
}

TEST_CASE("a missing scenario is bad input for every command that reads one") {
    for (const std::string command : {"critical-angle", "safety-factor", "run", "validate", "theory"}) {
        CAPTURE(command);
        const Outcome outcome = runTalus({command, "no-such-file.toml", "--json"});
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.json().at("errors").at(0).at("file") == "no-such-file.toml");
        CHECK(outcome.err.find("no-such-file.toml: error: ") != std::string::npos);
    }
}

TEST_CASE("a full disk behind stdout is the file system's refusal") {
    const Outcome outcome = runTalus({"theory", "table1"}, "/dev/full");
    CHECK(outcome.exit_code == 4);
    CHECK(outcome.err.find("stdout") != std::string::npos);
}

TEST_CASE("a stream that was closed takes no file's place: what is printed is written into none") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write(
        "run.toml", blockScenario(10, 20, "[run]\nduration_s = 0.01\nframe_interval_s = 0.002\n"));
    for (const std::string closed : {">&-", "2>&-", "<&-", ">&- 2>&-", ">&- 2>&- <&-"})
        for (const std::string name : {"run.mcap", "run.csv"}) {
            CAPTURE(closed);
            CAPTURE(name);
            const std::string path = folder / name;
            const std::string line = "'" + std::string(TALUS_PROGRAM) + "' run '" + scenario + "' -o '" +
                                     path + "' --force >'" + (folder / "out") + "' 2>'" + (folder / "err") +
                                     "' " + closed;
            CHECK(std::system(line.c_str()) == 0);
            if (name == "run.mcap")
                CHECK(runTalus({"inspect", path, "--verify"}).exit_code == 0);
            else
                CHECK(contentOf(path).ends_with("\n# end: finished\n"));
        }
}

TEST_CASE("files that may grow no further are the file system's refusal, as a full disk is") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("block.toml", blockScenario(0, 20));
    const std::vector<std::vector<std::string>> commands{
        {"--help"},
        {"theory", "table1"},
        {"critical-angle", scenario, "--json"},
        {"blocks", scenario, "-o", folder / "blocks.svg", "--quiet"}};
    for (const auto& arguments : commands) {
        CAPTURE(arguments.front());
        Program program(Room{0}, arguments);
        CHECK(program.outcome().exit_code == 4);
    }
    CHECK(folder.files() == 1);
}

TEST_CASE("a scenario whose path is not UTF-8 has its answers, and the files drawn of it are XML") {
    const TemporaryFolder folder;
    const std::string scenario =
        folder.write("sl\xff\xfe.toml", blockScenario(10, 20, "[run]\nduration_s = 0.01\n"));
    const std::string shown = "sl\ufffd\ufffd.toml", run = folder / "run.mcap",
                      picture = folder / "blocks.svg";
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{"critical-angle", scenario},
                                               {"limit-analysis", scenario, "--for", "tilt"},
                                               {"theory", scenario},
                                               {"validate", scenario},
                                               {"run", scenario, "-o", run},
                                               {"inspect", run},
                                               {"blocks", scenario, "-o", picture}}) {
        CAPTURE(command.front());
        std::vector<std::string> arguments = command;
        arguments.push_back("--json");
        const Outcome outcome = runTalus(arguments);
        CHECK(outcome.exit_code == 0);
        const std::string json = outcome.json().dump();
        CHECK((command.front() == "validate" || json.find(shown) != std::string::npos));
    }
    CHECK(contentOf(picture).find(shown) != std::string::npos);
    CHECK(contentOf(picture).find('\xff') == std::string::npos);
}

TEST_CASE("talus -V, and talus help COMMAND") {
    CHECK(runTalus({"-V"}).out == runTalus({"--version"}).out);
    CHECK(runTalus({"help"}).out == runTalus({"--help"}).out);
    CHECK(runTalus({"help", "run"}).out == runTalus({"run", "--help"}).out);
    CHECK(runTalus({"help", "runn"}).err.find("did you mean 'run'?") != std::string::npos);
}

TEST_CASE("more threads than cores are had, without a word; every instruction set gives the same bits") {
    const TemporaryFolder folder;
    const std::string path = folder.write("s.toml", blockScenario(0, 20));
    const Outcome many = runTalus({"critical-angle", path, "--threads", "8", "--json"});
    CHECK(many.exit_code == 0);
    CHECK(many.err.find("TBB") == std::string::npos);
    const auto with = [&](const char* set) {
        setenv("TALUS_INSTRUCTION_SET", set, 1);
        const Outcome outcome = runTalus({"critical-angle", path, "--json"});
        unsetenv("TALUS_INSTRUCTION_SET");
        return outcome;
    };
    CHECK(with("x86-64").json().at("state_hash") == many.json().at("state_hash"));
    const Outcome none = with("neon");
    CHECK(none.exit_code == 2);
    CHECK(none.err.find("allowed: \"x86-64\"") != std::string::npos);
}
