// talus run with snapshots: killed at any moment its frames are there, and resumed it ends as if it had not
// been.

#include <doctest/doctest.h>

#include <random>

#include "support/snapshots.h"
#include "tools/program.h"

using namespace talus::tools::testing;
using talus::formats::inspectSnapshot;
using talus::formats::SnapshotFile;
using talus::formats::SnapshotReader;

namespace {

bool isSnapshot(const std::string& path) {
    const SnapshotFile file = inspectSnapshot(path);
    return file == SnapshotFile::unfinished || file == SnapshotFile::finished;
}

std::string hashOf(const Outcome& outcome) { return outcome.json().at("state_hash"); }

}  // namespace

TEST_CASE("kill -9 at random moments: complete frames are read back, --resume ends in the same state") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("run.toml", talus::test::runScenarioText("0.6"));
    const Outcome whole = runTalus({"run", scenario, "-o", folder / "whole.mcap", "--json", "--quiet"});
    REQUIRE(whole.exit_code == 0);
    REQUIRE(SnapshotReader::open(folder / "whole.mcap")->verify().empty());
    const double wall = whole.json().at("wall_seconds");
    std::mt19937 random(20240611);
    for (int k = 0; k < 6; ++k) {
        const std::string path = folder / ("killed" + std::to_string(k) + ".mcap");
        Program program({"run", scenario, "-o", path, "--full-every", "7"});
        // Begun at least: on a busy machine it may be done before anybody looks.
        REQUIRE(waitFor([&] { return isSnapshot(path); }));
        std::this_thread::sleep_for(
            std::chrono::duration<double>(std::uniform_real_distribution<>(0, 0.8 * wall)(random)));
        program.signal(SIGKILL);
        if (program.outcome().exit_code != 128 + SIGKILL) continue;     // it was done before
        if (inspectSnapshot(path) == SnapshotFile::finished) continue;  // and so was its file
        auto reader = SnapshotReader::open(path);
        REQUIRE(reader.ok());
        for (std::size_t frame = 0; frame < reader->frames().size(); ++frame)
            CHECK(reader->frame(frame).ok());
        CHECK_FALSE(reader->faults().empty());
        if (reader->fulls() == 0)
            continue;  // killed before the first one was written: that is said, and refused
        const Outcome resumed = runTalus({"run", "--resume", path, "--threads", k % 2 ? "1" : "2", "--json"});
        REQUIRE(resumed.exit_code == 0);
        CHECK(hashOf(resumed) == hashOf(whole));
        CHECK(resumed.json().at("steps") == whole.json().at("steps"));
        auto completed = SnapshotReader::open(path);
        CHECK(completed->verify().empty());
        CHECK(completed->frames().size() == SnapshotReader::open(folder / "whole.mcap")->frames().size());
    }
    CHECK(folder.files() >= 2 + 6);
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(folder / ""))) {
        const std::string extension = entry.path().extension();
        CHECK((extension == ".toml" || extension == ".mcap"));  // no temporary file is left
    }
}

TEST_CASE("a run that was cut off anywhere behind its last frame is finished once more, and only then") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("run.toml", talus::test::runScenarioText("0.2"));
    const std::string path = folder / "whole.mcap", cut = folder / "cut.mcap";
    const Outcome whole = runTalus({"run", scenario, "-o", path, "--json", "--quiet"});
    REQUIRE(whole.exit_code == 0);
    CHECK(runTalus({"run", "--resume", path, "--quiet"}).exit_code == 2);  // nothing left to do
    const auto size = std::filesystem::file_size(path);
    int finished_before = 0;
    for (const std::uintmax_t missing : {1, 8, 9, 37, 100, 300, 600, 900, 1200, 1500, 2000, 3000, 5000}) {
        CAPTURE(missing);
        std::filesystem::copy_file(path, cut, std::filesystem::copy_options::overwrite_existing);
        std::filesystem::resize_file(cut, size - missing);
        finished_before += inspectSnapshot(cut) == SnapshotFile::finished;
        const Outcome resumed = runTalus({"run", "--resume", cut, "--json", "--quiet"});
        REQUIRE(resumed.exit_code == 0);
        CHECK(hashOf(resumed) == hashOf(whole));
        auto completed = SnapshotReader::open(cut);
        REQUIRE(completed.ok());
        CHECK(completed->verify().empty());
        CHECK(completed->end()->ended == "finished");
        CHECK(completed->frames().size() == SnapshotReader::open(path)->frames().size());
    }
    CHECK(finished_before > 0);  // their last word was there, the index was not
}

TEST_CASE("an interrupted run is resumed in a copy; the file it came from stays") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("run.toml", talus::test::runScenarioText("0.3"));
    const Outcome whole = runTalus({"run", scenario, "--json", "--quiet"});
    Program program({"run", scenario, "-o", folder / "a.mcap", "--json"});
    REQUIRE(waitFor([&] {
        auto reader = SnapshotReader::open(folder / "a.mcap");
        return reader.ok() && reader->frames().size() > 20;
    }));
    program.signal(SIGINT);
    REQUIRE(program.outcome().exit_code == 130);
    auto reader = SnapshotReader::open(folder / "a.mcap");
    CHECK(reader->end()->ended == "interrupted");
    CHECK(reader->verify().empty());
    const std::string before = contentOf(folder / "a.mcap");
    const Outcome anew = runTalus({"run", scenario, "-o", folder / "a.mcap"});
    CHECK(anew.exit_code == 2);
    CHECK(anew.err.find("interrupted; talus run --resume continues it") != std::string::npos);
    const Outcome resumed =
        runTalus({"run", "--resume", folder / "a.mcap", "-o", folder / "b.mcap", "--json"});
    REQUIRE(resumed.exit_code == 0);
    CHECK(hashOf(resumed) == hashOf(whole));
    CHECK(contentOf(folder / "a.mcap") == before);
    CHECK(SnapshotReader::open(folder / "b.mcap")->verify().empty());
    // Finished now: not resumed, not overwritten.
    CHECK(runTalus({"run", "--resume", folder / "b.mcap"}).exit_code == 2);
    CHECK(runTalus({"run", scenario, "-o", folder / "b.mcap"}).exit_code == 2);
    CHECK(runTalus({"run", scenario, "-o", folder / "b.mcap", "--force", "--quiet"}).exit_code == 0);
}

TEST_CASE("wrong uses of -o and --resume are refused and change nothing") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("run.toml", talus::test::runScenarioText("0.005"));
    const std::string notes = folder.write("notes.mcap", "not a snapshot file\n");
    CHECK(runTalus({"run", scenario, "-o", notes}).exit_code == 2);
    CHECK(contentOf(notes) == "not a snapshot file\n");
    CHECK(runTalus({"run", "--resume", notes}).exit_code == 2);
    CHECK(runTalus({"run", "--resume", folder / "absent.mcap"}).exit_code == 2);
    CHECK(runTalus({"run"}).exit_code == 2);
    REQUIRE(runTalus({"run", scenario, "-o", folder / "a.mcap", "--quiet"}).exit_code == 0);
    CHECK(runTalus({"run", scenario, "--resume", folder / "a.mcap"}).exit_code == 2);
    CHECK(runTalus({"run", "--resume", folder / "a.mcap", "-o", folder / "a.csv"}).exit_code == 2);
    CHECK(runTalus({"run", scenario, "-o", "/dev/full", "--quiet"}).exit_code == 4);
    CHECK(runTalus({"run", scenario, "-o", folder / "no/folder.mcap", "--quiet"}).exit_code == 4);
}
