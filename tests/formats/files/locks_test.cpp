// One writer at a time, on file systems whose locks reach as far as they should; inputs are known under all
// their names.

#include "talus/formats/locks.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <linux/fs.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "support/files.h"
#include "talus/formats/inputs.h"
#include "talus/formats/output_file.h"

using namespace talus::formats;
using talus::test::contentOf;
using talus::test::TemporaryFolder;

TEST_CASE("a file that is being written is not opened a second time, and is free afterwards") {
    const TemporaryFolder folder;
    const std::string path = folder.write("out.mcap", "before");
    {
        const auto first = OutputFile::open(path);
        REQUIRE(first.ok());
        const auto second = OutputFile::open(path);
        REQUIRE_FALSE(second.ok());
        CHECK(second.errors().front().field == path);
        CHECK(second.errors().front().message.find("another process") != std::string::npos);
    }
    CHECK(OutputFile::open(path).ok());
    CHECK(contentOf(path) == "before");
}

TEST_CASE("a file that got nothing is taken away, one that was replaced meanwhile is not") {
    const TemporaryFolder folder;
    { CHECK(OutputFile::open(folder / "new").ok()); }
    CHECK(folder.files() == 0);
    CHECK_FALSE(OutputFile::openExisting(folder / "new").ok());
    {
        const auto file = OutputFile::open(folder / "new");
        REQUIRE(file.ok());
        CHECK(::unlink((folder / "new").c_str()) == 0);
        folder.write("new", "");
        CHECK(file->sync(0) == ENOENT);
    }
    CHECK(folder.files() == 1);
}

TEST_CASE("a file that is shorter or longer than the written bytes is reported at its end") {
    const TemporaryFolder folder;
    const std::string path = folder / "new";
    const auto file = OutputFile::open(path);
    REQUIRE(file.ok());
    REQUIRE(::write(file->file(), "12345", 5) == 5);
    CHECK(file->sync(5) == 0);
    for (const std::uintmax_t size : {3, 7}) {
        std::filesystem::resize_file(path, size);
        CHECK(file->sync(5) == ENOENT);
    }
    const auto device = OutputFile::open("/dev/null");
    REQUIRE(device.ok());
    CHECK(device->sync(5) == 0);
}

TEST_CASE("of two that make one file at the same moment one has it, and the other leaves it alone") {
    const TemporaryFolder folder;
    constexpr int kRounds = 10000;
    std::atomic<int> ready = 0, done = 0, writers = 0, lost = 0;
    const auto meet = [](std::atomic<int>& count, int round) {
        ++count;
        while (count < 2 * (round + 1)) std::this_thread::yield();
    };
    const auto write = [&](int delay) {
        for (int k = 0; k < kRounds; ++k) {
            meet(ready, k);
            for (volatile int wait = delay * (k % 40); wait > 0;) wait = wait - 1;
            const auto file = OutputFile::open(folder / std::to_string(k));
            if (file.ok()) {
                writers += ::write(file->file(), "x", 1) == 1;
            }
            meet(done, k);  // both have had their go: what one of them wrote is still there
            lost += file.ok() && !std::filesystem::exists(file->path());
        }
    };
    { const std::jthread one(write, 0), two(write, 100); }
    CHECK(lost.load() == 0);
    CHECK(writers.load() == kRounds);
}

TEST_CASE("a link that leads to nothing is not followed to a new file") {
    const TemporaryFolder folder;
    std::filesystem::create_symlink(folder / "elsewhere", folder / "link");
    CHECK_FALSE(OutputFile::open(folder / "link").ok());
    CHECK(folder.files() == 1);
}

TEST_CASE("locks that do not reach other machines are known by kind and options of the mount") {
    CHECK(lockReach("ext4", "rw,nolock") == LockReach::every_machine);
    CHECK(lockReach("nfs4", "rw,vers=4.2,local_lock=none") == LockReach::every_machine);
    CHECK(lockReach("nfs", "rw,nolock,local_lock=all") == LockReach::this_machine);
    CHECK(lockReach("nfs", "rw,local_lock=posix") == LockReach::this_machine);
    CHECK(lockReach("lustre", "rw,localflock") == LockReach::this_machine);
    CHECK(lockReach("lustre", "rw,noflock") == LockReach::none);
    CHECK(lockReach("lustre", "rw,flock") == LockReach::every_machine);
    CHECK(lockReach("cifs", "rw,nobrl") == LockReach::this_machine);
    CHECK(lockWarning(LockReach::every_machine).empty());
    CHECK_FALSE(lockWarning(LockReach::none).empty());
}

TEST_CASE("an input is known under every name that leads to it") {
    const TemporaryFolder folder;
    const std::string path = folder.write("slope.toml", "x");
    const std::string other = folder.write("other.toml", "x");
    rememberInput(path);
    std::filesystem::create_symlink(path, folder / "symbolic");
    std::filesystem::create_hard_link(path, folder / "hard");
    for (const std::string name : {"slope.toml", "symbolic", "hard"}) CHECK(isInput(folder / name));
    CHECK_FALSE(isInput(other));
    CHECK_FALSE(isInput(folder / "absent"));
}

TEST_CASE("a file with the inode of a removed input is no input") {
    const TemporaryFolder folder;
    int generation = 0;
    const int probe = ::open(folder.write("probe", "x").c_str(), O_RDONLY);
    const bool has_generations = ::ioctl(probe, FS_IOC_GETVERSION, &generation) == 0;
    ::close(probe);
    for (int k = 0; k < 30; ++k) {
        const std::string input = folder.write("input-" + std::to_string(k), "x");
        rememberInput(input);
        CHECK(isInput(input));
        std::filesystem::remove(input);
        // Without generations only the time of birth tells them apart, and clocks of file systems tick every
        // few ms.
        if (!has_generations) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        CHECK_FALSE(isInput(folder.write("output-" + std::to_string(k), "y")));
    }
}
