// Files are written whole or not at all; numbers never reach JSON as nan.

#include <doctest/doctest.h>

#include <cmath>

#include "cli/failures.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/text.h"
#include "support/files.h"

using namespace talus::tools;
using talus::test::contentOf;
using talus::test::TemporaryFolder;

TEST_CASE("a file is written and replaced, and nothing else is left beside it") {
    const TemporaryFolder folder;
    writeFile(folder / "a.txt", "one");
    writeFile(folder / "a.txt", "two");
    CHECK(contentOf(folder / "a.txt") == "two");
    CHECK(folder.files() == 1);
}

TEST_CASE("a link stays a link: what it leads to is written") {
    const TemporaryFolder folder;
    folder.write("a.txt", "one");
    std::filesystem::create_symlink(folder / "a.txt", folder / "link.txt");
    writeFile(folder / "link.txt", "two");
    CHECK(contentOf(folder / "a.txt") == "two");
    CHECK(std::filesystem::is_symlink(folder / "link.txt"));
    CHECK(folder.files() == 2);
}

TEST_CASE("refusals of the file system are thrown with path and reason") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(writeFile(folder / "no/folder.txt", "text"), FileRefused);
    CHECK_THROWS_AS(writeFile("/dev/full", "text"), FileRefused);
    folder.write("file", "");
    CHECK_THROWS_AS(makeFolder(folder / "file/below"), FileRefused);
    try {
        writeFile("/dev/full", "text");
    } catch (const FileRefused& refused) {
        CHECK(std::string(refused.what()).find("/dev/full: ") == 0);
    }
}

TEST_CASE("a folder that cannot be replaced by a file leaves no temporary behind") {
    const TemporaryFolder folder;
    makeFolder(folder / "here/and/below");
    CHECK_THROWS_AS(writeFile(folder / "here", "text"), FileRefused);
    CHECK(folder.files() == 1);
}

TEST_CASE("numbers as text and JSON") {
    CHECK(number(1.5) == 1.5);
    CHECK(number(std::nan("")).is_null());
    CHECK(number(INFINITY).is_null());
    CHECK(text(19.5, 3) == "19.500");
    CHECK(text(-INFINITY, 3) == "-infinite");
    CHECK(text(1e308, 2).size() == 312);
    CHECK(hashText(0xABCu) == "0000000000000abc");
}
