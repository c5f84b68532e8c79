// Runs and batches under attack, with fixed seeds: killed at any moment, two at one file, no room left, files
// with changed bytes and right checksums. What was written stays readable, what goes on ends in the same
// bits, what is refused is said.

#include <doctest/doctest.h>

#include <random>

#include "support/containers.h"
#include "support/snapshots.h"
#include "tools/batch_folder.h"

namespace talus::tools::testing {

namespace {

using formats::inspectSnapshot;
using formats::SnapshotFile;
using formats::SnapshotReader;

constexpr int kKills = 100;

using Random = std::mt19937;
double between(double low, double high, Random& random) {
    return std::uniform_real_distribution<>(low, high)(random);
}

/// Kills it after so many seconds. \return whether it was still going on
bool killAfter(double seconds, Program& program) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    program.signal(SIGKILL);
    return program.outcome().exit_code == 128 + SIGKILL;
}

/// A run and what it leaves behind when nobody disturbs it.
struct WholeRun {
    TemporaryFolder folder;
    std::string scenario, path = folder / "whole.mcap";
    std::vector<std::uint64_t> hashes{};  ///< of each frame
    double wall = 0;                      ///< [s]

    explicit WholeRun(const std::string& duration)
        : scenario(folder.write("run.toml", test::runScenarioText(duration))) {
        const Outcome outcome = runTalus({"run", scenario, "-o", path, "--json", "--quiet"});
        REQUIRE(outcome.exit_code == 0);
        wall = outcome.json().at("wall_seconds");
        hashes = hashesOf(path);
    }

    static std::vector<std::uint64_t> hashesOf(const std::string& path) {
        std::vector<std::uint64_t> all;
        auto reader = SnapshotReader::open(path);
        REQUIRE(reader.ok());
        for (std::size_t k = 0; k < reader->frames().size(); ++k) {
            const auto frame = reader->frame(k);
            REQUIRE(frame.ok());
            all.push_back(frame->state_hash);
        }
        return all;
    }

    /// What brings the file at `at` nearer to its end.
    std::vector<std::string> nextCommand(const std::string& at) const {
        const auto reader = SnapshotReader::open(at);
        if (reader.ok() && reader->fulls() > 0) return {"run", "--resume", at, "--quiet"};
        return {"run", scenario, "-o", at, "--full-every", "7", "--force", "--quiet"};
    }

    /// Every frame so far is one of the undisturbed run's.
    void checkFrames(const std::string& at) const {
        if (!SnapshotReader::open(at).ok()) return;  // killed before there was anything
        const auto so_far = hashesOf(at);
        REQUIRE(so_far.size() <= hashes.size());
        CHECK(std::equal(so_far.begin(), so_far.end(), hashes.begin()));
    }

    void checkFinished(const std::string& at) const {
        auto reader = SnapshotReader::open(at);
        REQUIRE(reader.ok());
        for (const std::string& fault : reader->verify()) FAIL_CHECK(fault);
        CHECK(hashesOf(at) == hashes);
    }
};

mcap::Bytes bytesOf(const std::string& path) {
    const std::string text = contentOf(path);
    return {text.begin(), text.end()};
}

/// Finished, and with the index at its end.
bool isWhole(const std::string& path) {
    return inspectSnapshot(path) == SnapshotFile::finished && SnapshotReader::open(path)->faults().empty();
}

/// A few bytes changed, most of them to values that lengths and offsets mistake for something; the checksums
/// are right.
mcap::Bytes damaged(mcap::Bytes bytes, Random& random) {
    for (int k = 1 + static_cast<int>(random() % 6); k > 0; --k) {
        const std::uint8_t values[] = {0, 1, 0x7f, 0x80, 0xff, static_cast<std::uint8_t>(random())};
        bytes[mcap::kMagic.size() + random() % (bytes.size() - mcap::kMagic.size())] =
            values[random() % std::size(values)];
    }
    test::seal(bytes);
    return bytes;
}

/// Ends by itself, or soon after Ctrl-C; done, refused or interrupted, never by a signal or an internal
/// error.
void checkEnds(const std::vector<std::string>& arguments) {
    CAPTURE(arguments.front());
    CAPTURE(arguments[1]);
    Program program(arguments);
    if (!program.endsWithin(3)) {
        program.signal(SIGINT);
        CHECK(program.endsWithin(5));
    }
    const int code = program.outcome().exit_code;
    CHECK_MESSAGE((code == 0 || (code >= 2 && code <= 4) || code == 130), "exit code ", code);
}

}  // namespace

TEST_SUITE("slow: attacks") {
    TEST_CASE(
        "100 kills of runs at random moments: all frames are right, the last resume ends in the same bits") {
        const WholeRun whole("0.3");
        Random random(20261122);
        int kills = 0;
        for (int chain = 0; kills < kKills; ++chain) {
            const std::string path = whole.folder / ("killed" + std::to_string(chain) + ".mcap");
            while (!isWhole(path)) {
                Program program(whole.nextCommand(path));
                kills += killAfter(between(0, 0.7 * whole.wall, random), program);
                whole.checkFrames(path);
            }
            whole.checkFinished(path);
        }
    }

    TEST_CASE("100 kills of batches at random moments: the rows are those of an undisturbed batch") {
        const BatchFolder batch(draws(80));
        const std::string whole = batch.folder / "whole";
        const auto begin = std::chrono::steady_clock::now();
        REQUIRE(runTalus({"batch", batch.path, "-o", whole, "--quiet"}).exit_code == 0);
        const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        const auto rows = rowsOf(whole + "/results.csv");
        Random random(7);
        int kills = 0;
        for (int chain = 0; kills < kKills; ++chain) {
            const std::string out = batch.folder / ("out" + std::to_string(chain));
            for (bool done = false; !done;) {
                Program program(
                    {"batch", batch.path, "-o", out, "--quiet", "--threads", chain % 2 ? "1" : "2"});
                done = !killAfter(between(0, 0.5 * wall, random), program);
                kills += !done;
            }
            CHECK(runTalus({"batch", batch.path, "-o", out, "--quiet"}).exit_code == 0);
            CHECK(rowsOf(out + "/results.csv") == rows);
        }
    }

    TEST_CASE("two at one file, again and again: one of them writes it, the other says why not") {
        const WholeRun whole("0.05");
        for (int k = 0; k < 30; ++k) {
            const std::string path = whole.folder / ("two" + std::to_string(k) + ".mcap");
            const std::vector<std::string> fresh{"run", whole.scenario, "-o", path, "--quiet"};
            // Both go on with what a killed run left; one that is done before, on a machine that was busier
            // at first, is begun anew and killed earlier.
            bool was_killed = k % 2 == 0;
            for (double wait = 0.5 * whole.wall; !was_killed; wait *= 0.5) {
                Program program(
                    {"run", whole.scenario, "-o", path, "--full-every", "3", "--quiet", "--force"});
                was_killed = killAfter(wait, program);
            }
            const auto command = k % 2 != 0 ? whole.nextCommand(path) : fresh;
            Program one(command), two(command);
            int codes[]{one.outcome().exit_code, two.outcome().exit_code};
            std::sort(std::begin(codes), std::end(codes));
            // The second came while the first one wrote (4), or when its file was finished (2, but that
            // --force writes it anew).
            const bool forced = std::count(command.begin(), command.end(), "--force") > 0;
            CHECK(codes[0] == 0);
            CHECK((codes[1] == 4 || codes[1] == (forced ? 0 : 2)));
            whole.checkFinished(path);
        }
    }

    TEST_CASE(
        "files without room end with 4 wherever that was, and go on to the same bits once there is room") {
        const WholeRun whole("0.1");
        const std::uintmax_t size = std::filesystem::file_size(whole.path);
        for (std::size_t kib = 1; kib * 1024 < size; kib = kib * 4 / 3 + 1) {
            CAPTURE(kib);
            const std::string path = whole.folder / (std::to_string(kib) + ".mcap");
            Program program(Room{kib}, {"run", whole.scenario, "-o", path, "--full-every", "3", "--quiet"});
            const Outcome outcome = program.outcome();
            CHECK(outcome.exit_code == 4);
            CHECK(outcome.err.find("File too large") != std::string::npos);
            if (inspectSnapshot(path) != SnapshotFile::absent) whole.checkFrames(path);
            REQUIRE(runTalus(whole.nextCommand(path)).exit_code == 0);
            whole.checkFinished(path);
        }
        const BatchFolder batch(draws(40));
        REQUIRE(batch.run().exit_code == 0);
        const std::string out = batch.folder / "small", results = "/results.csv";
        Program program(Room{3}, {"batch", batch.path, "-o", out, "--quiet"});
        CHECK(program.outcome().exit_code == 4);
        CHECK(runTalus({"batch", batch.path, "-o", out, "--quiet"}).exit_code == 0);
        CHECK(rowsOf(out + results) == rowsOf(batch.out() + results));
    }

    TEST_CASE("damaged files with right checksums: every command ends, and none by a signal") {
        const WholeRun whole("0.02");
        const mcap::Bytes sound = bytesOf(whole.path), stored = test::unpacked(sound);
        Random random(99);
        for (int k = 0; k < 150; ++k) {
            const mcap::Bytes bytes = damaged(k % 3 == 0 ? sound : stored, random);
            const std::string path = whole.folder.write("damaged.mcap", {bytes.begin(), bytes.end()});
            checkEnds({"inspect", path, "--verify"});
            checkEnds({"run", "--resume", path, "-o", whole.folder / "resumed.mcap", "--force", "--quiet"});
            checkEnds({"export", path, "--csv", whole.folder / "motion.csv"});
            checkEnds({"replay", path, "-o", whole.folder / "page.html", "--force"});
        }
    }
}

}  // namespace talus::tools::testing
