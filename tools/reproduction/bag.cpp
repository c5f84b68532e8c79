#include "reproduction/bag.h"

#include <algorithm>
#include <cmath>

#include "cli/failures.h"
#include "cli/text.h"
#include "reproduction/scenario_text.h"

namespace talus::tools {
namespace {

constexpr double kDuration = 1.0;   ///< the supply fills the bag again within it [s]
constexpr double kFrame = 0.01;     ///< [s]
constexpr int kFramesPerFull = 50;  ///< replay needs poses alone
constexpr double kDamping = 1e-5;   ///< of contacts: damps chatter, not sliding [s]
constexpr double kMovesWith = 0.5;  ///< share of the watched block's displacement beyond which a block slides
constexpr const char* kOpening = "0.005";  ///< width of the bag [m]; the paper has none
constexpr const char* kSupply = "0.001";   ///< [m3/s per m of width]; the paper has none

std::string watched(int fissure) { return "c" + std::to_string(fissure) + "r1s1"; }

using Settings = std::vector<std::pair<const char*, std::string>>;

formats::Scenario scenarioOf(const std::string& slope, int fissure, double tilt_deg, const Settings& water) {
    std::string made = withValue(slope, "[[stack]]", "slices", "1");
    made = withValue(made, "[gravity]", "tilt_deg", text(tilt_deg, 6));
    made = withValue(made, "[damping]", "contact", text(kDamping, 6));
    made = withValue(made, "[run]", "duration_s", text(kDuration, 3));
    made = withValue(made, "[run]", "frame_interval_s", text(kFrame, 3));
    made = withValue(made, "[run]", "watch", "[\"" + watched(fissure) + "\"]");
    for (const auto& [key, value] : water) made = withValue(made, "[[water]]", key, value);
    return valueOf(formats::parseScenario(made, "water-bag.toml"));
}

BagInstant instantOf(const HistoryRecord& record, double held_level) {
    const BlockReport& block = record.watch.front();
    return {record.time, record.waters.empty() ? held_level : record.waters.front().level,
            block.displacement.norm(), block.velocity.norm()};
}

/// Blocks displaced like the watched one slide, the others stay.
void addRoles(KeptRun& kept, double watched_displacement) {
    const auto& [x, y, z] = kept.last.displacement;
    for (std::size_t b = 0; b < x.size(); ++b) {
        const Block& block = kept.scenario.model.blocks[b];
        const double displacement = std::hypot(double{x[b]}, double{y[b]}, double{z[b]});
        const bool slides = displacement > kMovesWith * watched_displacement;
        kept.failure.roles.push_back(slides ? FailureMode::sliding : FailureMode::none);
        if (block.motion != Motion::fixed) (slides ? kept.slides : kept.stays).push_back(block.name);
    }
}

}  // namespace

std::vector<BagRun> bagRuns(const std::string& slope, int fissure, double tilt_deg) {
    const auto made = [&](const char* id, const char* name, const Settings& water) {
        BagRun bag{id, name};
        bag.run.scenario = scenarioOf(slope, fissure, tilt_deg, water);
        return bag;
    };
    BagRun held = made("held", "level held", {});
    const std::string depth = text(held.run.scenario.model.waters.front().level.front().value, 6);
    const Settings bag{{"volume", "\"closed\""}, {"opening", kOpening}};
    Settings supplied = bag;
    supplied.insert(supplied.end(), {{"inflow", kSupply}, {"overflow", depth}});
    return {std::move(held), made("bag", "bag without a supply", bag),
            made("supply", "bag with a supply", supplied)};
}

void playBagRun(BagRun& bag, const Common& common, const Control& control) {
    KeptRun& kept = bag.run;
    const RunOptions options = optionsToKeep(common, bag.id, bag.file, true, kFramesPerFull, "--keep-run");
    RunRecorder recorder(options, kept.scenario, nullptr);
    const double held = kept.scenario.model.waters.front().level.front().value;
    RunOutput output = recorder.output();
    output.begin = [&, begin = output.begin](const RunGeometry& geometry) {
        kept.geometry = geometry;
        begin(geometry);
    };
    output.record = [&](const HistoryRecord& record) { bag.history.push_back(instantOf(record, held)); };
    output.light = [&, light = output.light](LightFrame&& frame) {
        kept.last = frame;
        light(std::move(frame));
    };
    auto outcome = run(kept.scenario.model, control, output);
    recorder.finish(outcome);
    kept.run = valueOf(std::move(outcome), kept.scenario);
    kept.file = bag.file;
    if (!bag.history.empty()) addRoles(kept, bag.history.back().displacement);
}

}  // namespace talus::tools
