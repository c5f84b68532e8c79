// Two processes at one file, outputs that would replace inputs, files removed during writing: no loss goes
// unreported.

#include <doctest/doctest.h>

#include "support/snapshots.h"
#include "tools/program.h"

using namespace talus::tools::testing;
using talus::formats::inspectSnapshot;
using talus::formats::SnapshotFile;
using talus::formats::SnapshotReader;

namespace {

/// A run that goes on until it is told to end.
struct LongRun {
    TemporaryFolder folder;
    std::string scenario = folder.write("run.toml", talus::test::runScenarioText("1000"));
};

}  // namespace

TEST_CASE("a second writer gets 4 and a sentence, and the first one's file stays whole") {
    const LongRun run;
    for (const std::string name : {"live.mcap", "live.csv"}) {
        CAPTURE(name);
        const std::string path = run.folder / name;
        Program first({"run", run.scenario, "-o", path, "--quiet"});
        REQUIRE(waitFor(
            [&] { return std::filesystem::exists(path) && std::filesystem::file_size(path) > 2000; }));
        std::vector<std::vector<std::string>> seconds{{"run", run.scenario, "-o", path, "--quiet"},
                                                      {"run", run.scenario, "-o", path, "--force"}};
        if (name == "live.mcap") seconds.push_back({"run", "--resume", path});
        for (const auto& arguments : seconds) {
            const Outcome second = runTalus(arguments);
            CHECK(second.exit_code == 4);
            CHECK(second.err.find("is being written by another process") != std::string::npos);
        }
        first.signal(SIGINT);
        CHECK(first.outcome().exit_code == 130);
    }
    CHECK(SnapshotReader::open(run.folder / "live.mcap")->verify().empty());
}

TEST_CASE("removal of a file during writing is reported") {
    const LongRun run;
    std::filesystem::create_directory(run.folder / "gone");
    const std::string path = run.folder / "gone/run.mcap";
    Program program({"run", run.scenario, "-o", path, "--quiet"});
    REQUIRE(waitFor([&] { return inspectSnapshot(path) == SnapshotFile::unfinished; }));
    std::filesystem::remove_all(run.folder / "gone");
    program.signal(SIGINT);
    const Outcome outcome = program.outcome();
    CHECK(outcome.exit_code == 4);
    CHECK(outcome.err.find("was removed, replaced or truncated") != std::string::npos);
}

TEST_CASE("truncation of a file during writing is reported at the next write") {
    const LongRun run;
    for (const std::string name : {"cut.mcap", "cut.csv"}) {
        CAPTURE(name);
        const std::string path = run.folder / name;
        Program program({"run", run.scenario, "-o", path, "--quiet"});
        REQUIRE(waitFor(
            [&] { return std::filesystem::exists(path) && std::filesystem::file_size(path) > 2000; }));
        std::filesystem::resize_file(path, 100);
        CHECK(program.endsWithin(60));
        program.signal(SIGINT);
        const Outcome outcome = program.outcome();
        CHECK(outcome.exit_code == 4);
        CHECK(outcome.err.find("truncated while it was being written") != std::string::npos);
    }
}

TEST_CASE("no output replaces what the command reads, under whatever name and --force or not") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("run.toml", talus::test::runScenarioText("0.005"));
    const std::string run = folder / "run.mcap";
    REQUIRE(runTalus({"run", scenario, "-o", run, "--quiet"}).exit_code == 0);
    std::filesystem::create_hard_link(run, folder / "hard.csv");
    std::filesystem::create_symlink(run, folder / "link.mcap");
    std::filesystem::create_symlink(scenario, folder / "scenario.mcap");
    folder.write("hillside.obj", "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    const std::string mesh = folder.write(
        "mesh.toml",
        "[material.rock]\ndensity = 2600\n[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\n"
        "friction_deg = 30\n[rock_mass]\nregion = { obj = \"hillside.obj\" }\n");
    REQUIRE(runTalus({"blocks", mesh, "-o", folder / "blocks.obj", "--quiet"}).exit_code == 0);
    const auto contents = [&] {
        return contentOf(run) + contentOf(scenario) + contentOf(folder / "hillside.obj");
    };
    const std::string before = contents();
    const std::vector<std::vector<std::string>> attempts{
        {"export", run, "--csv", run},
        {"export", run, "--csv", folder / "hard.csv"},
        {"export", run, "--stl", "last", "-o", run},
        {"blocks", mesh, "-o", folder / "hillside.obj"},
        {"run", "--resume", run, "-o", scenario, "--force"},
        {"run", "--resume", run, "-o", folder / "scenario.mcap", "--force"},
        {"run", scenario, "-o", folder / "scenario.mcap", "--force"},
        {"replay", run, "-o", folder / "scenario.mcap", "--force"},
        {"replay", folder / "link.mcap", "-o", run, "--force"},
        {"critical-angle", scenario, "--keep-run", folder / "scenario.mcap", "--force"},
    };
    for (const auto& arguments : attempts) {
        CAPTURE(arguments.front());
        CAPTURE(arguments.back());
        CHECK(runTalus(arguments).exit_code == 2);
        CHECK(contents() == before);
    }
    CHECK(runTalus({"run", scenario, "-o", folder / "out.vtk"}).exit_code == 2);
    CHECK_FALSE(std::filesystem::exists(folder / "out.vtk"));
}
