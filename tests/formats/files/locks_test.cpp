// One writer at a time, on file systems whose locks reach as far as they should; inputs are known under all their names.

#include "talus/formats/locks.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

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
        CHECK(file->sync() == ENOENT);
    }
    CHECK(folder.files() == 1);
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
