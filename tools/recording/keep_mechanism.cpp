#include "recording/keep_mechanism.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "cli/failures.h"
#include "cli/json.h"
#include "cli/text.h"
#include "recording/start_frame.h"
#include "report/numbers.h"
#include "talus/formats/failing.h"
#include "talus/motion_roles.h"

namespace talus::tools {

namespace {

constexpr int kFrames = 48;       // behind the first
constexpr double kSeconds = 2.0;  // they last
// Of the moving blocks' median size: displacement of the fastest corner.
constexpr double kDisplacementOfSize = 0.3;
constexpr const char* kSource = "limit-analysis --for ";

/// Of each of the model's blocks; those that are not free stay.
struct Velocity {
    Vec3 velocity = Vec3::Zero(), spin = Vec3::Zero();  ///< [m/s, rad/s]
    bool moving = false;
};

std::vector<Velocity> velocitiesOf(const LimitResult& result, const Model& model) {
    std::vector<Velocity> velocities;
    auto next = result.mechanism.begin();
    for (const Block& block : model.blocks) {
        velocities.emplace_back();
        if (next == result.mechanism.end() || next->block != block.name) continue;
        velocities.back() = {next->velocity, next->spin, next->moving};
        ++next;
    }
    return velocities;
}

double medianSize(const StartFrame& start, const std::vector<Velocity>& velocities) {
    std::vector<double> sizes;
    for (std::size_t b = 0; b < velocities.size(); ++b)
        if (velocities[b].moving) sizes.push_back(start.geometry.size[b]);
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return *middle;
}

Vec3 at(const VectorList<double>& list, std::size_t k) { return {list.x[k], list.y[k], list.z[k]}; }

double radiusOf(const RunGeometry& geometry, std::size_t block) {
    double radius = 0;
    for (auto v = geometry.vertex_begin[block]; v < geometry.vertex_begin[block + 1]; ++v) {
        const Vec3 arm = at(geometry.vertex, static_cast<std::size_t>(v)) - at(geometry.centroid, block);
        radius = std::max(radius, arm.norm());
    }
    return radius;
}

/// By the rule of searches, from the final positions.
formats::SnapshotFailure failureOf(const StartFrame& start, const Model& model,
                                   const std::vector<Velocity>& velocities, double displacement) {
    std::vector<BlockDisplacement> displacements;
    for (std::size_t b = 0; b < velocities.size(); ++b) {
        const Vec3 moved = displacement * velocities[b].velocity;
        displacements.push_back({.free = model.blocks[b].motion == Motion::free,
                                 .position = at(start.geometry.centroid, b) + moved,
                                 .radius = radiusOf(start.geometry, b),
                                 .translation = moved.norm(),
                                 .rotation = displacement * velocities[b].spin.norm(),
                                 .mass = start.geometry.mass[b]});
    }
    formats::SnapshotFailure failure;
    failure.roles = motionRoles(displacements, 0);
    failure.mode = overallMode(displacements, failure.roles);
    return failure;
}

/// The blocks at a share of their path.
LightFrame frameAt(const LightFrame& start, const std::vector<Velocity>& velocities, double displacement,
                   int k) {
    const double share = static_cast<double>(k) / kFrames;
    LightFrame frame = start;
    frame.step = k;
    frame.time = share * kSeconds;
    frame.kinetic_energy = frame.elastic_energy = frame.gravity_energy = frame.out_of_balance = 0;
    frame.displacement = frame.rotation = frame.velocity = {};
    for (const Velocity& block : velocities) {
        frame.displacement.push_back(share * displacement * block.velocity);
        frame.rotation.push_back(share * displacement * block.spin);
        frame.velocity.push_back(displacement / kSeconds * block.velocity);
    }
    return frame;
}

std::string remarkOn(const formats::Scenario& scenario, const VariedQuantity& load) {
    return scenario.path +
           " at the limit of rigid blocks.\nWritten by talus limit-analysis --keep-mechanism: the mechanism "
           "of the linear programme (" +
           std::string(load.limit) + "), at the beginning of motion only. No forces drive the blocks.";
}

}  // namespace

void addKeepMechanism(CLI::App& app, KeepMechanismOptions& options) {
    auto* file = app.add_option(
        "--keep-mechanism", options.file,
        "FILE.mcap: the mechanism at the limit, as a motion for talus replay, inspect and export");
    app.add_flag("--force", options.force,
                 "Replace the file of --keep-mechanism even if it holds a finished run or is of another kind")
        ->needs(file);
}

std::string mechanismSource(const VariedQuantity& load) { return std::string(kSource) + load.name; }

const VariedQuantity* mechanismLoad(const std::string& analysis) {
    if (!analysis.starts_with(kSource)) return nullptr;
    return variedNamed(std::string_view(analysis).substr(std::string_view(kSource).size()));
}

MechanismKeeper::MechanismKeeper(const KeepMechanismOptions& options, const Common& common,
                                 const formats::Scenario& scenario)
    : options_(options), scenario_(scenario) {
    if (options.file.empty()) return;
    run_options_ =
        optionsToKeep(common, scenario.path, options.file, options.force, kFrames, "--keep-mechanism");
    recorder_ = std::make_unique<RunRecorder>(run_options_, at_limit_, nullptr);
}

void MechanismKeeper::write(const LimitResult& result, const VariedQuantity& load, double limit,
                            KeptMechanism& kept) {
    formats::FailingLoad failing;
    failing.varied = load.varied;
    failing.value = limit;
    failing.duration = kSeconds;
    failing.frame_interval = kSeconds / kFrames;
    at_limit_ = valueOf(formats::failingScenario(scenario_, failing, remarkOn(scenario_, load)));
    const StartFrame start = startFrame(at_limit_.model);
    const std::vector<Velocity> velocities = velocitiesOf(result, at_limit_.model);
    kept.displacement = kDisplacementOfSize * medianSize(start, velocities);
    formats::SnapshotFailure failure = failureOf(start, at_limit_.model, velocities, kept.displacement);
    failure.analysis = mechanismSource(load);
    failure.load = limit;
    kept.mode = failure.mode;

    const RunOutput output = recorder_->output(std::move(failure));
    output.begin(start.geometry);
    for (int k = 0; k <= kFrames; ++k) output.light(frameAt(start.frame, velocities, kept.displacement, k));
    kept.frames = kFrames + 1;
    RunResult end;
    end.steps = kFrames;
    end.simulated_seconds = kSeconds;
    end.state_hash = start.frame.state_hash;
    recorder_->finish(end);
    kept.bytes = recorder_->bytes();
    kept.file = options_.file;
}

KeptMechanism MechanismKeeper::keep(const LimitResult& result, const VariedQuantity& load) {
    KeptMechanism kept;
    if (result.moving_blocks.empty()) {
        kept.reason =
            result.status == SearchStatus::stable_to_stop ? "nothing fails" : "no mechanism was found";
        return kept;
    }
    // A model that is stable at no load fails at the first load.
    try {
        write(result, load, std::isfinite(result.upper) ? result.upper : result.lower, kept);
    } catch (const FileRefused& refused) {
        kept.exit_code = kFileRefused, kept.reason = refused.what();
        note(run_options_.common, "error: the mechanism is not kept: " + kept.reason);
    }
    return kept;
}

Json keptMechanismJson(const KeptMechanism& kept) {
    if (kept.file.empty()) return {{"file", nullptr}, {"reason", kept.reason}};
    return {{"file", kept.file},
            {"reason", nullptr},
            {"mode", toString(kept.mode)},
            {"farthest_way_m", number(kept.displacement)},
            {"farthest_displacement_m", number(kept.displacement)},
            {"frames", kept.frames},
            {"bytes", kept.bytes}};
}

std::string keptMechanismText(const KeptMechanism& kept) {
    if (kept.file.empty()) return "none: " + kept.reason;
    return kept.file + ": " + toString(kept.mode) + ", " + std::to_string(kept.frames) +
           " frames up to a displacement of " + text(kept.displacement, 3) + " m";
}

}  // namespace talus::tools
