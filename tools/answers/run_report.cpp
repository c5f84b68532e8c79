#include "answers/run_report.h"

#include <algorithm>

#include "answers/support_report.h"
#include "cli/json.h"
#include "cli/provenance.h"
#include "cli/scenario.h"
#include "cli/text.h"

namespace talus::tools {

RunResult runRecorded(const formats::Scenario& scenario, const FullFrame* resume, RunRecorder& recorder,
                      const Control& control, MotionWatch* watch) {
    const RunOutput output = watch ? watch->watching(recorder.output()) : recorder.output();
    Result<RunResult> outcome = run(scenario.model, control, output, resume);
    recorder.finish(outcome);
    return valueOf(std::move(outcome), scenario);
}

std::size_t farthestBlock(const RunResult& result) {
    const auto& all = result.displacements;
    return static_cast<std::size_t>(
        std::max_element(all.begin(), all.end(),
                         [](const Vec3& a, const Vec3& b) { return a.norm() < b.norm(); }) -
        all.begin());
}

namespace {

Json watchJson(const RunResult& result) {
    Json watch = Json::object();
    for (const BlockReport& block : result.watch)
        watch[block.name] = {{"position_m", vector(block.position)},
                             {"velocity_m_s", vector(block.velocity)},
                             {"rotation_deg", number(degrees(block.rotation))},
                             {"displacement_m", vector(block.displacement)}};
    return watch;
}

/// Displacement of every block that moves; the largest is the usual result after an earthquake.
Json displacementsJson(const formats::Scenario& scenario, const RunResult& result) {
    Json all = Json::object();
    for (std::size_t b = 0; b < result.displacements.size(); ++b)
        if (scenario.model.blocks[b].motion != Motion::fixed)
            all[scenario.model.blocks[b].name] = vector(result.displacements[b]);
    return all;
}

Json largestJson(const formats::Scenario& scenario, const RunResult& result) {
    const std::size_t block = farthestBlock(result);
    return {{"block", scenario.model.blocks[block].name},
            {"displacement_m", number(result.displacements[block].norm())}};
}

/// Closed volumes at the end.
Json watersJson(const RunResult& result) {
    Json waters = Json::array();
    for (const WaterReport& water : result.waters)
        waters.push_back({{"name", water.name},
                          {"level_m", number(water.level)},
                          {"volume_m3", number(water.volume)},
                          {"run_over_m3", number(water.run_over)}});
    return waters;
}

}  // namespace

Json runJson(const RunOptions& options, const formats::Scenario& scenario, const RunResult& result,
             const RunRecorder& recorder) {
    Json json{
        {"steps", result.steps},
        {"simulated_seconds", number(result.simulated_seconds)},
        {"time_step_s", number(result.time_step)},
        {"start", options.resume.empty() && result.began ? Json(toString(result.start)) : Json(nullptr)},
        {"blocks", result.blocks},
        {"interfaces", result.interfaces},
        {"contact_points", result.contact_points},
        {"kinetic_energy_j", number(result.kinetic_energy)},
        {"state_hash", hashText(result.state_hash)},
        {"wall_seconds", number(result.wall_seconds)},
        {"watch", watchJson(result)},
        {"displacements_m",
         scenario.model.ground_motion.empty() ? Json(nullptr) : displacementsJson(scenario, result)},
        {"largest_displacement", largestJson(scenario, result)}};
    addSupports(result.supports, json);
    if (!result.waters.empty()) json["waters"] = watersJson(result);
    json["interrupted"] = result.interrupted;
    json["warnings"] = warningsJson(scenario, result.warnings);
    json["output"] = options.output.empty() ? Json(nullptr) : Json(options.output);
    json["snapshots"] = recorder.facts();
    json["resumed"] = options.resume.empty() ? Json(nullptr) : Json(options.resume);
    json["provenance"] = provenance(options.common, options.scenario.name());
    return json;
}

}  // namespace talus::tools
