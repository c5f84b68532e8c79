// The CSV history: what stands in it while it is written, after it is finished, and when nothing was written.

#include "talus/formats/history.h"

#include <doctest/doctest.h>

#include "support/files.h"

using namespace talus;
using namespace talus::formats;

namespace {

/// Where a history goes.
struct Place {
    test::TemporaryFolder folder;
    std::string path = folder / "history.csv";
    std::string content() const { return test::contentOf(path); }
};

HistoryRecord record(double time, std::int64_t step) {
    HistoryRecord result;
    result.time = time;
    result.step = step;
    result.kinetic_energy = 1.0 / 3;
    BlockReport block;
    block.name = "key";
    block.position = {0.1, 0.2, 0.3};
    block.velocity = {-1, 0, 2.5};
    block.rotation = 3.14159265358979323846;
    result.watch.push_back(block);
    return result;
}

}  // namespace

TEST_CASE("rows are in the file as soon as they are written") {
    const Place file;
    auto writer = HistoryWriter::open(file.path, "# version: 1\n", {"key"});
    REQUIRE(writer.ok());
    CHECK(writer->write(record(0, 0)).empty());
    CHECK(writer->write(record(0.25, 10)).empty());
    const std::string text = file.content();
    CHECK(text.starts_with("# talus history\n# version: 1\n"));
    CHECK(text.ends_with("\n0.25,10,0.3333333333333333,0,0,0,0.1,0.2,0.3,-1,0,2.5,180\n"));
    CHECK(inspectHistory(file.path) == HistoryFile::unfinished);
    CHECK(writer->finish("finished").empty());
    CHECK(file.content() == text + "# end: finished\n");
    CHECK(inspectHistory(file.path) == HistoryFile::finished);
}

TEST_CASE("closed volumes of water have columns of their own") {
    const Place file;
    auto writer = HistoryWriter::open(file.path, "", {"key"});
    REQUIRE(writer.ok());
    HistoryRecord first = record(0, 0);
    first.waters = {{"water[0]", 0.35, 7e-5, 1e-6, 2e-6}};
    CHECK(writer->write(first).empty());
    const std::string text = file.content();
    CHECK(text.find(
              "rotation_deg,water[0].level_m,water[0].volume_m3,water[0].run_over_m3,water[0].leaked_m3\n") !=
          std::string::npos);
    CHECK(text.ends_with(",180,0.35,7e-05,1e-06,2e-06\n"));
}

TEST_CASE("column names carry units, and quotes where a block's name needs them") {
    const Place file;
    auto writer = HistoryWriter::open(file.path, "", {"a,\"b\""});
    REQUIRE(writer.ok());
    CHECK(writer->write(record(0, 0)).empty());
    CHECK(file.content().find(",\"a,\"\"b\"\".x_m\",") != std::string::npos);
    CHECK(file.content().find("time_s,step,kinetic_energy_j,") != std::string::npos);
}

TEST_CASE("without a record a new file disappears and an old one is as it was") {
    const Place file;
    { CHECK(HistoryWriter::open(file.path, "", {}).ok()); }
    CHECK(inspectHistory(file.path) == HistoryFile::absent);
    file.folder.write("history.csv", "old text\n");
    { CHECK(HistoryWriter::open(file.path, "", {}).ok()); }
    CHECK(file.content() == "old text\n");
    CHECK(inspectHistory(file.path) == HistoryFile::foreign);
}

TEST_CASE("a longer old history leaves nothing behind a shorter new one") {
    const Place file;
    file.folder.write("history.csv", std::string(10000, 'x'));
    auto writer = HistoryWriter::open(file.path, "", {});
    REQUIRE(writer.ok());
    CHECK(writer->write(record(0, 0)).empty());
    CHECK(file.content().find('x') == std::string::npos);
}

TEST_CASE("an empty file, a device and a path that is not there") {
    const Place file;
    file.folder.write("history.csv", "");
    CHECK(inspectHistory(file.path) == HistoryFile::empty);
    CHECK(inspectHistory("/dev/null") == HistoryFile::absent);
    CHECK(inspectHistory(file.path + ".not") == HistoryFile::absent);
}

TEST_CASE("refusals of the file system are errors that name the path") {
    const auto missing = HistoryWriter::open("/no/such/folder/history.csv", "", {});
    REQUIRE_FALSE(missing.ok());
    CHECK(missing.errors().front().field == "/no/such/folder/history.csv");
    auto full = HistoryWriter::open("/dev/full", "", {});
    REQUIRE(full.ok());
    const auto errors = full->write(record(0, 0));
    REQUIRE(errors.size() == 1);
    CHECK(errors.front().field == "/dev/full");
    CHECK(full->write(record(1, 1)).empty());  // reported once
}
