// Messages with changed bytes and sound checksums: what a hostile file holds. They are refused or read as
// other numbers; nothing reads beyond its arrays (the sanitizer build watches), in the reader and in the
// engine that resumes from them.

#include <doctest/doctest.h>

#include <random>

#include "snapshot/convert.h"
#include "support/snapshots.h"

using namespace talus;
using namespace talus::formats;
using namespace talus::test;

namespace {

/// Changes a few bytes, mostly to values that lengths and offsets mistake for something.
mcap::Bytes mutated(mcap::Bytes bytes, std::mt19937& random) {
    const auto place = [&] {
        return std::uniform_int_distribution<std::size_t>(0, bytes.size() - 1)(random);
    };
    for (int k = 1 + static_cast<int>(random() % 4); k > 0; --k) {
        const std::uint8_t values[] = {0, 1, 0x7f, 0x80, 0xff, static_cast<std::uint8_t>(random())};
        bytes[place()] = values[random() % std::size(values)];
    }
    if (random() % 8 == 0) bytes.resize(place() + 1);
    return bytes;
}

}  // namespace

TEST_CASE("changed messages are refused or harmless") {
    const Scenario scenario = *parseScenario(runScenarioText("0.002"), "run.toml");
    const Recorded run = record(scenario.model, 1);
    const SnapshotHeader header = headerOf(scenario, run.geometry, "talus run", 1);
    const mcap::Bytes header_bytes = encode(header), light_bytes = encode(run.lights.back()),
                      full_bytes = encode(run.fulls.back());
    std::mt19937 random(7);
    std::size_t read = 0, resumed = 0;
    for (int k = 0; k < 3000; ++k) {
        SnapshotHeader changed;
        std::string why;
        if (decode(mutated(header_bytes, random), changed, why) && fits(changed)) ++read;
        LightFrame light;
        if (decode(mutated(light_bytes, random), light) && fits(light, header)) ++read;
        FullFrame full;
        if (!decode(mutated(full_bytes, random), full) || !fits(full, header)) continue;
        ++read;
        full.state_hash = hashOf(full);
        full.progress.time_step = 1e-5;
        std::atomic<bool> stop = true;  // restored, then stopped before the first step
        Control control;
        control.stop = &stop;
        resumed += record(scenario.model, 1, &full, control).result.ok();
    }
    CHECK(read > 1000);  // most changes hit numbers
    CHECK(resumed > 100);
}
