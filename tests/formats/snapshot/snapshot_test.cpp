// Snapshot files: every value is read back, and unfinished and damaged files give their whole part.

#include "talus/formats/snapshot.h"

#include <doctest/doctest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>

#include "snapshot/convert.h"
#include "support/files.h"
#include "support/snapshots.h"

using namespace talus;
using namespace talus::formats;
using namespace talus::test;

namespace {

struct Sample {
    Scenario scenario = *parseScenario(runScenarioText("0.02"), "run.toml");
    Recorded run = record(scenario.model, 5);
};

const Sample& sample() {
    static const Sample made;
    return made;
}

}  // namespace

TEST_CASE("every message survives writing and reading, to the bit") {
    const TemporaryFolder folder;
    const Sample& s = sample();
    REQUIRE(s.run.result.ok());
    REQUIRE(writeFile(folder / "a.mcap", s.scenario, s.run).empty());
    auto reader = SnapshotReader::open(folder / "a.mcap");
    REQUIRE(reader.ok());
    CHECK(reader->faults().empty());
    CHECK(reader->verify().empty());
    REQUIRE(reader->frames().size() == s.run.lights.size());
    REQUIRE(reader->fulls() == s.run.fulls.size());
    // A message is a function of its values, so equal messages are equal values.
    for (std::size_t k = 0; k < s.run.lights.size(); ++k)
        CHECK(encode(*reader->frame(k)) == encode(s.run.lights[k]));
    for (std::size_t k = 0; k < s.run.fulls.size(); ++k)
        CHECK(encode(*reader->full(k)) == encode(s.run.fulls[k]));
    const SnapshotHeader header = headerOf(s.scenario, s.run.geometry, "talus run", 10);
    CHECK(encode(reader->header()) == encode(header));
    CHECK(reader->header().scenario_text == s.scenario.text);
    REQUIRE(reader->end().has_value());
    CHECK(reader->end()->ended == "finished");
    CHECK(reader->end()->state_hash == s.run.result->state_hash);
    CHECK(reader->end()->steps == s.run.result->steps);
    // A full state read back is as good as the one handed out.
    const FullFrame middle = *reader->full(2);
    CHECK(record(s.scenario.model, 5, &middle).result->state_hash == s.run.result->state_hash);
}

TEST_CASE("a header tells the parts of blocks, and which faces are inside; of convex blocks nothing") {
    Scenario scenario = *parseScenario(runScenarioText("0.002"), "run.toml");
    CHECK(record(scenario.model).geometry.face_part.empty());
    CHECK(record(scenario.model).geometry.face_inner.empty());
    const auto cube = [](double x) { return *makeBox({x, 0, 5}, {x + 1, 1, 6}); };
    Block& block = scenario.model.blocks.back();
    block.shape = *joinParts({cube(2), cube(3)});
    block.face_joint.assign(block.shape.faces.size(), 0);
    scenario.model.waters.clear();
    const Recorded run = record(scenario.model);
    for (const Error& error : run.result.errors()) FAIL_CHECK(error.message);
    SnapshotHeader header = headerOf(scenario, run.geometry, "talus run", 10);
    const auto first = static_cast<std::size_t>(run.geometry.face_begin.back()) - 12;
    CHECK(std::count(run.geometry.face_inner.begin(), run.geometry.face_inner.end(), 1) == 2);
    CHECK(run.geometry.face_part[first] == 0);
    CHECK(run.geometry.face_part.back() == 1);
    const TemporaryFolder folder;
    REQUIRE(writeFile(folder / "a.mcap", scenario, run).empty());
    auto reader = SnapshotReader::open(folder / "a.mcap");
    REQUIRE(reader.ok());
    CHECK(reader->header().geometry.face_part == run.geometry.face_part);
    CHECK(reader->header().geometry.face_inner == run.geometry.face_inner);
    CHECK(fits(header));
    header.geometry.face_inner.pop_back();
    CHECK_FALSE(fits(header));
}

TEST_CASE("a header without flow has no table of it; one with flow gives it back, and indices are checked") {
    SnapshotHeader header = headerOf(sample().scenario, sample().run.geometry, "talus run", 10);
    const mcap::Bytes dry = encode(header);
    header.flow.emplace();
    for (const double x : {0.0, 1.0, 2.0, 3.0}) header.flow->node.push_back(Vec3(x, 2 * x, 0.1));
    header.flow->pressure = {9810, 0, -4905, 1};
    header.flow->triangle = {0, 1, 2, 2, 1, 3};
    header.flow->joint = {0, 0};
    header.flow->block_a = {0, 1};
    header.flow->block_b = {1, 2};
    CHECK(fits(header));
    const mcap::Bytes wet = encode(header);
    CHECK(wet.size() > dry.size());
    SnapshotHeader read;
    std::string why;
    REQUIRE(decode(wet, read, why));
    REQUIRE(read.flow.has_value());
    CHECK(encode(read) == wet);
    CHECK(read.flow->pressure == header.flow->pressure);
    read.flow.reset();
    CHECK(encode(read) == dry);
    const auto misfits = [&](const auto& change) {
        SnapshotHeader damaged = header;
        change(*damaged.flow);
        return !fits(damaged);
    };
    CHECK(misfits([](SnapshotFlow& flow) { flow.triangle[3] = 4; }));
    CHECK(misfits([](SnapshotFlow& flow) { flow.triangle.pop_back(); }));
    CHECK(misfits([](SnapshotFlow& flow) { flow.pressure.pop_back(); }));
    CHECK(misfits([](SnapshotFlow& flow) { flow.block_b[0] = -1; }));
    CHECK(misfits([](SnapshotFlow& flow) { flow.block_a[1] = 1000; }));
    CHECK(misfits([](SnapshotFlow& flow) { flow.joint[0] = 1000; }));
}

TEST_CASE("an unfinished file gives its frames and says that it has no end") {
    const TemporaryFolder folder;
    const Sample& s = sample();
    REQUIRE(writeFile(folder / "a.mcap", s.scenario, s.run, false).empty());
    CHECK(inspectSnapshot(folder / "a.mcap") == SnapshotFile::unfinished);
    auto reader = SnapshotReader::open(folder / "a.mcap");
    REQUIRE(reader.ok());
    CHECK(reader->frames().size() == s.run.lights.size());
    CHECK_FALSE(reader->end().has_value());
    REQUIRE(reader->faults().size() == 2);
    CHECK(reader->faults()[1].find("frames up to t =") != std::string::npos);
}

TEST_CASE("kinds of files at a path are distinguished") {
    const TemporaryFolder folder;
    CHECK(inspectSnapshot(folder / "none.mcap") == SnapshotFile::absent);
    CHECK(inspectSnapshot(folder.write("empty.mcap", "")) == SnapshotFile::empty);
    CHECK(inspectSnapshot(folder.write("other.mcap", "something else")) == SnapshotFile::foreign);
    REQUIRE(writeFile(folder / "a.mcap", sample().scenario, sample().run).empty());
    CHECK(inspectSnapshot(folder / "a.mcap") == SnapshotFile::finished);
    CHECK(SnapshotReader::open(folder / "none.mcap").errors()[0].message.find("No such file") !=
          std::string::npos);
    CHECK(SnapshotReader::open(folder / "other.mcap").errors()[0].message.find("not an MCAP") !=
          std::string::npos);
}

TEST_CASE("joints of every law come back from a header, which says that it has them") {
    SnapshotHeader header = headerOf(sample().scenario, sample().run.geometry, "", 10);
    CHECK(header.format == kFirstFormat);
    Scenario scenario = sample().scenario;
    auto& joints = scenario.model.joints;
    joints.resize(4, joints[0]);
    for (std::size_t k = 1; k < 4; ++k) {
        joints[k].name = toString(static_cast<StrengthLaw>(k));
        joints[k].law = static_cast<StrengthLaw>(k);
        for (const JointProperty& property : kJointProperties)
            joints[k].*property.value = 0.1 * static_cast<double>(k) + (property.isAngle() ? 0.01 : 3.0);
    }
    joints[2].shear_strength = {{0, 1}, {2, 3}, {4, 5}};
    header = headerOf(scenario, sample().run.geometry, "", 10);
    CHECK(header.format == kFormatWithLaws);
    SnapshotHeader read;
    std::string why;
    REQUIRE(decode(encode(header), read, why));
    REQUIRE(read.joints.size() == 4);
    for (std::size_t k = 0; k < 4; ++k) {
        CHECK((read.joints[k].law == joints[k].law));
        CHECK(read.joints[k].shear_strength == joints[k].shear_strength);
        for (const JointProperty& property : kJointProperties)
            CHECK(read.joints[k].*property.value == joints[k].*property.value);
    }
}

TEST_CASE("a header of a later format is refused") {
    SnapshotHeader header = headerOf(sample().scenario, sample().run.geometry, "", 10);
    header.format = kSnapshotFormat + 1;
    const mcap::Bytes message = encode(header);
    SnapshotHeader read;
    std::string why;
    CHECK_FALSE(decode(message, read, why));
    CHECK(why.find("later version") != std::string::npos);
}

TEST_CASE("messages whose arrays do not fit are noticed") {
    const SnapshotHeader header = headerOf(sample().scenario, sample().run.geometry, "", 10);
    CHECK(fits(header));
    SnapshotHeader damaged = header;
    damaged.geometry.face_vertex[3] = 100000;
    CHECK_FALSE(fits(damaged));
    LightFrame light = sample().run.lights[3];
    CHECK(fits(light, header));
    light.rotation.y.pop_back();
    CHECK_FALSE(fits(light, header));
    FullFrame full = sample().run.fulls[1];
    CHECK(fits(full, header));
    full.interfaces.block_b[1] = -4;
    CHECK_FALSE(fits(full, header));
}

TEST_CASE("a full disk ends the file at its last whole frame") {
    const TemporaryFolder folder;
    const Sample& s = sample();
    REQUIRE(writeFile(folder / "whole.mcap", s.scenario, s.run).empty());
    const auto size = contentOf(folder / "whole.mcap").size();
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limited = before;
    limited.rlim_cur = size / 2;
    setrlimit(RLIMIT_FSIZE, &limited);
    const std::vector<Error> errors = writeFile(folder / "cut.mcap", s.scenario, s.run);
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].message.find("cannot be written") != std::string::npos);
    auto reader = SnapshotReader::open(folder / "cut.mcap");
    REQUIRE(reader.ok());
    CHECK(reader->frames().size() > 3);
    CHECK(reader->frames().size() < s.run.lights.size());
    for (std::size_t k = 0; k < reader->frames().size(); ++k) CHECK(reader->frame(k).ok());
    CHECK_FALSE(reader->end().has_value());
}

TEST_CASE("a writer that got nothing leaves nothing, and leaves alone what was there") {
    const TemporaryFolder folder;
    { const auto writer = SnapshotWriter::open(folder / "new.mcap"); }
    CHECK_FALSE(std::filesystem::exists(folder / "new.mcap"));
    folder.write("old.mcap", "something");
    { const auto writer = SnapshotWriter::open(folder / "old.mcap"); }
    CHECK(contentOf(folder / "old.mcap") == "something");
    CHECK_FALSE(SnapshotWriter::open(folder / "no/folder.mcap").ok());
}
