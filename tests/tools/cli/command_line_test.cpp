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
