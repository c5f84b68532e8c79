#include "recording/keep_run.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "cli/block_names.h"
#include "cli/json.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "report/numbers.h"
#include "talus/formats/failing.h"

namespace talus::tools {

namespace {

// A slope's own time is sqrt(size / g), about the time in which a block falls by its own size. Released at 8
// cells of 0.006 deg beyond the failing tilt, a sliding block moves by its size in 50 of them; a toppling one
// is faster.
constexpr double kMostTimes = 60;     // of that time
constexpr double kFramesPerTime = 8;  // light frames in one
constexpr int kFramesInGivenTime = 200;
constexpr int kFramesPerFull = 20;

double ownTime(double block_size, double gravity) {
    return gravity > 0 ? std::sqrt(block_size / gravity) : 1.0;
}

/// With one decimal more than the answer's, because it lies a fraction of the bracket beyond it.
std::string loadText(const KeptRun& kept) {
    return talus::tools::loadText(*kept.search, kept.failure.load, kept.search->load->decimals + 1);
}

std::string whyNothing(const SearchResult& result) {
    if (!leftOut(result).empty())
        return "blocks were removed before the answer, but the scenario still has them";
    switch (result.status) {
        case SearchStatus::stable_to_stop:
            return "the slope is stable up to the largest load tried";
        case SearchStatus::interrupted:
            return "the search was interrupted";
        default:
            return "the search is undecided";
    }
}

/// The blocks' roles in the search, in the order of the model's blocks.
void addRoles(const SearchResult& result, const Model& model, KeptRun& kept) {
    std::unordered_map<std::string, FailureMode> modes;
    for (const BlockMotion& motion : result.motions) modes.emplace(motion.block, motion.mode);
    for (const Block& block : model.blocks) {
        const auto found = modes.find(block.name);
        const FailureMode mode = found == modes.end() ? FailureMode::none : found->second;
        kept.failure.roles.push_back(mode);
        if (block.motion != Motion::free) continue;
        (mode == FailureMode::none      ? kept.stays
         : mode == FailureMode::sliding ? kept.slides
                                        : kept.topples)
            .push_back(block.name);
    }
}

/// The factor at which each block fails, in the order of the model's blocks; empty where no group is known.
std::vector<double> factorsOf(const SearchResult& result, const Model& model) {
    if (result.groups.empty()) return {};
    std::unordered_map<std::string, double> factors;
    for (const BlockGroup& group : result.groups)
        for (const std::string& block : group.blocks) factors.emplace(block, group.factor);
    std::vector<double> list;
    for (const Block& block : model.blocks) {
        const auto found = factors.find(block.name);
        list.push_back(found == factors.end() ? 0.0 : found->second);
    }
    return list;
}

std::string remarkOn(const formats::Scenario& scenario, const FailingState& failing, const KeptRun& kept) {
    std::string remark = scenario.path + " as it fails: " + loadText(kept) +
                         ", just beyond the first that fails.\nWritten by talus " + kept.search->name +
                         " --keep-run. The dashpots in [damping] only damp the chatter of contacts.";
    if (scenario.model.hasWater() && failing.state.loads.water_share < 1)
        remark += "\nIt already fails under its weight: the kept run has no water pressure.";
    return remark;
}

void findFarthest(KeptRun& kept) {
    const auto& way = kept.last.displacement;
    for (std::size_t b = 0; b < way.x.size(); ++b) {
        const double gone = Vec3(way.x[b], way.y[b], way.z[b]).norm();
        if (gone <= kept.farthest_way) continue;
        kept.farthest_way = gone;
        kept.farthest = kept.scenario.model.blocks[b].name;
    }
}

}  // namespace

void addKeepRun(CLI::App& app, KeepRunOptions& options) {
    auto* file = app.add_option("--keep-run", options.file,
                                "FILE.mcap: compute the motion after failure with true inertia and keep it "
                                "for talus replay, inspect and export");
    app.add_option("--keep-run-time", options.seconds,
                   "Duration of that motion [s]; default: until a block is displaced by its own size, at "
                   "most 60 sqrt(size / g)")
        ->check(CLI::PositiveNumber)
        ->needs(file);
    app.add_flag("--force", options.force,
                 "Replace the file of --keep-run even if it holds a finished run or is of another kind")
        ->needs(file);
}

FailureKeeper::FailureKeeper(const KeepRunOptions& options, const Common& common,
                             const formats::Scenario& scenario)
    : options_(options), scenario_(scenario) {
    if (options.file.empty()) return;
    run_options_ =
        optionsToKeep(common, scenario.path, options.file, options.force, kFramesPerFull, "--keep-run");
    recorder_ = std::make_unique<RunRecorder>(run_options_, as_it_fails_, nullptr);
}

void FailureKeeper::play(const FailingState& failing, KeptRun& kept, const Control& control) {
    const double time = ownTime(failing.block_size, scenario_.model.gravity.magnitude);
    formats::FailingLoad load;
    load.varied = kept.search->load->varied;
    load.value = failing.load;
    load.contact_damping = failing.contact_damping;
    load.duration = options_.seconds.value_or(kMostTimes * time);
    load.frame_interval = options_.seconds ? *options_.seconds / kFramesInGivenTime : time / kFramesPerTime;
    as_it_fails_ = valueOf(formats::failingScenario(scenario_, load, remarkOn(scenario_, failing, kept)));

    RunOutput output = recorder_->output(kept.failure);
    output.begin = [&, begin = output.begin](const RunGeometry& geometry) {
        kept.geometry = geometry;
        begin(geometry);
    };
    output.light = [&, light = output.light](LightFrame&& frame) {
        kept.last = frame;
        ++kept.frames;
        light(std::move(frame));
    };
    output.full = [&, full = output.full](FullFrame&& frame) {
        ++kept.fulls;
        full(std::move(frame));
    };
    const double far_enough = options_.seconds ? kInfinity : failing.block_size;
    auto outcome = runFailing(as_it_fails_.model, control, output, failing, far_enough);
    recorder_->finish(outcome);
    kept.run = valueOf(std::move(outcome), as_it_fails_);
    kept.file = options_.file;
    kept.bytes = recorder_->bytes();
    const auto& flow = as_it_fails_.model.flow;
    if (flow && !flow->coupled && load.varied == Varied::tilt)
        kept.run.warnings.emplace_back(
            "the flow of this run is that of the failing tilt; the search kept the flow of the scenario's "
            "tilt. With flow.coupled = true, and no wet_strength_factor, the search follows the tilt");
    if (kept.run.interrupted) kept.exit_code = kInterrupted, kept.reason = "interrupted";
}

KeptRun FailureKeeper::keep(const SearchResult& result, const LoadSearch& search, const Control& control) {
    KeptRun kept;
    kept.search = &search;
    if (!result.failing) {
        kept.reason = whyNothing(result);
        return kept;
    }
    kept.failure = {search.name, result.failing->load, result.mode, {}, factorsOf(result, scenario_.model)};
    if (result.status == SearchStatus::found) {
        kept.failure.answer = result.answer, kept.failure.stands = result.low,
        kept.failure.fails = result.high;
        kept.failure.path = result.path;
    }
    addRoles(result, scenario_.model, kept);
    try {
        play(*result.failing, kept, control);
    } catch (const FileRefused& refused) {
        kept.exit_code = kFileRefused, kept.reason = refused.what();
    } catch (const BadInput& bad) {
        kept.exit_code = kBadInput, kept.reason = formats::format(bad.errors.front());
    }
    if (kept.exit_code == kFileRefused || kept.exit_code == kBadInput)
        note(run_options_.common, "error: the failing run is not kept: " + kept.reason);
    kept.scenario = as_it_fails_;
    if (!kept.last.displacement.x.empty()) findFarthest(kept);
    return kept;
}

Json keptRunJson(const KeptRun& kept) {
    if (kept.file.empty()) return {{"file", nullptr}, {"reason", kept.reason}};
    return {{"file", kept.file},
            {"reason", kept.reason.empty() ? Json(nullptr) : Json(kept.reason)},
            {kept.search->load->key, number(kept.failure.load / kept.search->load->scale)},
            {"simulated_seconds", number(kept.run.simulated_seconds)},
            {"steps", kept.run.steps},
            {"time_step_s", number(kept.run.time_step)},
            {"frames", kept.frames},
            {"full_states", kept.fulls},
            {"bytes", kept.bytes},
            {"state_hash", hashText(kept.run.state_hash)},
            {"wall_seconds", number(kept.run.wall_seconds)},
            {"farthest_block", kept.farthest},
            {"farthest_displacement_m", number(kept.farthest_way)},
            {"slides", kept.slides},
            {"topples", kept.topples},
            {"stays", kept.stays},
            {"warnings", kept.run.warnings}};
}

std::vector<std::pair<std::string, std::string>> keptRunLines(const KeptRun& kept) {
    if (kept.file.empty()) return {{"kept run", "none: " + kept.reason}};
    std::vector<std::pair<std::string, std::string>> lines{
        {"kept run", kept.file + ": " + loadText(kept) + ", " + text(kept.run.simulated_seconds, 3) + " s, " +
                         std::to_string(kept.frames) + " frames, " +
                         text(static_cast<double>(kept.bytes) / 1e6, 2) + " MB, " +
                         text(kept.run.wall_seconds, 2) + " s to compute"}};
    if (!kept.reason.empty()) lines.emplace_back("", kept.reason);
    lines.emplace_back("", kept.farthest + " moved farthest, " + text(kept.farthest_way, 4) + " m");
    for (const auto& [role, names] :
         {std::pair{"slides: ", &kept.slides}, {"topples: ", &kept.topples}, {"stays: ", &kept.stays}})
        if (!names->empty()) lines.emplace_back("", role + compactNames(*names));
    for (const std::string& warning : kept.run.warnings) lines.emplace_back("warning", warning);
    return lines;
}

}  // namespace talus::tools
