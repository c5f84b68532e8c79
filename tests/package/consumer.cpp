// Exits with 0 when the installed library is the version that was asked for, and reads a scenario, writes its
// run as snapshots and reads them again.
#include <talus/build_info.h>
#include <talus/formats/scenario.h>
#include <talus/formats/snapshot.h>
#include <talus/simulation.h>

#include <cstdio>

namespace formats = talus::formats;

/// Runs the scenario for a moment, its frames into a file. The number of frames that can be read again.
std::size_t framesOf(formats::Scenario scenario, const std::string& file) {
    scenario.model.run.duration = 1e-4;
    auto writer = formats::SnapshotWriter::open(file);
    if (!writer) return 0;
    talus::RunOutput output;
    output.begin = [&](const talus::RunGeometry& geometry) {
        writer->write(formats::headerOf(scenario, geometry, "consumer", output.frames_per_full));
    };
    output.light = [&](talus::LightFrame&& frame) { writer->write(std::move(frame)); };
    output.full = [&](talus::FullFrame&& frame) { writer->write(std::move(frame)); };
    const auto result = talus::run(scenario.model, {}, output);
    if (!result) return 0;
    writer->finish({"finished", result->steps, result->simulated_seconds, result->state_hash, 0, {}});
    const auto reader = formats::SnapshotReader::open(file);
    return reader && reader->faults().empty() ? reader->frames().size() : 0;
}

int main(int argc, char** argv) {
    const std::string& version = talus::buildInfo().version;
    std::printf("found talus %s, expected %s\n", version.c_str(), EXPECTED_VERSION);
    if (argc != 2 || version != EXPECTED_VERSION) return 1;
    const auto scenario = formats::readScenario(argv[1]);
    for (const talus::Error& error : scenario.errors()) std::printf("%s\n", formats::format(error).c_str());
    if (!scenario) return 1;
    const std::size_t frames = framesOf(*scenario, "consumer.mcap");
    std::printf("%zu blocks, %zu frames\n", scenario->model.blocks.size(), frames);
    return frames >= 2 ? 0 : 1;
}
