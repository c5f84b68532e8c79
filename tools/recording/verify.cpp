#include "recording/verify.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <mutex>
#include <optional>

#include "cli/common.h"
#include "cli/failures.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "talus/build_info.h"
#include "talus/formats/scenario.h"
#include "talus/parallel.h"
#include "talus/simulation.h"

namespace talus::tools {

namespace {

/// One stretch to compute: the state it starts from (none: the scenario) and the hashes it has to meet, in
/// order.
struct Task {
    std::optional<std::size_t> full;  ///< index of the full state
    struct Goal {
        std::int64_t step;
        std::uint64_t hash;
        double time;
    };
    std::vector<Goal> goals;
    double from = 0;  ///< [s]
};

Task::Goal goalOf(formats::SnapshotReader& reader, std::size_t frame) {
    const LightFrame light = valueOf(reader.frame(frame));
    return {light.step, light.state_hash, light.time};
}

/// Cuts the run at its full states. The first frame is computed from the scenario alone, except in a run that
/// a search has kept, which begins in a state of that search.
std::vector<Task> tasksOf(formats::SnapshotReader& reader) {
    std::vector<Task> tasks;
    const auto& frames = reader.frames();
    if (frames.empty()) return tasks;
    if (frames[0].time == 0 && !reader.header().failure)
        tasks.push_back({std::nullopt, {goalOf(reader, 0)}, 0});
    for (std::size_t k = 0; k < frames.size(); ++k) {
        if (k > 0 && !tasks.empty()) tasks.back().goals.push_back(goalOf(reader, k));
        if (frames[k].full) tasks.push_back({frames[k].full, {}, frames[k].time});
    }
    std::erase_if(tasks, [](const Task& task) { return task.goals.empty(); });
    return tasks;
}

/// Follows one computation, compares its output with the goals and stops it after the last.
class Follower {
 public:
    Follower(const Task& task, Stretch& result) : task_(task), result_(result) {}

    RunOutput output() {
        RunOutput output;
        output.frames_per_full = 1 << 30;
        output.light = [this](LightFrame&& frame) { meet(frame); };
        return output;
    }
    std::atomic<bool> stop = false;
    std::size_t met() const { return at_; }

 private:
    void meet(const LightFrame& frame) {
        if (at_ >= task_.goals.size() || !result_.fault.empty()) return;
        const Task::Goal& goal = task_.goals[at_];
        if (frame.step < goal.step) return;  // the file lacks this frame
        if (frame.step > goal.step) {        // it was written between frames, at an interruption
            stop = true;
            return;
        }
        if (frame.state_hash != goal.hash)
            result_.fault = "t = " + text(goal.time, 6) + " s, step " + std::to_string(goal.step) +
                            ": the file has " + hashText(goal.hash) + ", the recomputed run has " +
                            hashText(frame.state_hash);
        ++at_, ++result_.frames;
        if (at_ == task_.goals.size() || !result_.fault.empty()) stop = true;
        if (stopRequested()) stop = true;
    }

    const Task& task_;
    Stretch& result_;
    std::size_t at_ = 0;
};

/// Computes from `full` until the goals are met. A goal between the regular frames (the last one of an
/// interrupted run) gets its own computation, with a frame at that time.
void follow(const Model& model, std::optional<FullFrame> full, Task task, Stretch& result) {
    while (!task.goals.empty() && result.fault.empty() && !stopRequested()) {
        Follower follower(task, result);
        Control control;
        control.stop = &follower.stop;
        control.progress = [&](const Progress&) {
            if (stopRequested()) follower.stop = true;
        };
        const auto outcome = run(model, control, follower.output(), full ? &*full : nullptr);
        if (!outcome) {
            result.fault = formats::format(outcome.errors().front());
            return;
        }
        task.goals.erase(task.goals.begin(),
                         task.goals.begin() + static_cast<std::ptrdiff_t>(follower.met()));
        if (task.goals.empty() || !result.fault.empty()) return;
        if (follower.met() == 0 && full && full->progress.next_frame == task.goals.front().time) {
            result.fault =
                "t = " + text(task.goals.front().time, 6) + " s: the recomputed run has no such step";
            return;
        }
        if (full) full->progress.next_frame = task.goals.front().time;
    }
}

}  // namespace

bool Verification::equal() const {
    return !interrupted && std::all_of(stretches.begin(), stretches.end(),
                                       [](const Stretch& stretch) { return stretch.fault.empty(); });
}

bool sameBuild(const formats::SnapshotHeader& header) {
    const BuildInfo &then = header.build, &now = buildInfo();
    return then.git_hash == now.git_hash && then.compiler == now.compiler &&
           then.build_type == now.build_type && then.instruction_set == now.instruction_set;
}

Verification verifyRun(formats::SnapshotReader& reader, const Common& common,
                       const std::function<void(const Progress&)>& show) {
    const formats::SnapshotHeader& header = reader.header();
    const formats::Scenario scenario =
        valueOf(formats::parseScenario(header.scenario_text, header.scenario_path));
    const std::vector<Task> tasks = tasksOf(reader);
    Verification all;
    all.stretches.resize(tasks.size());
    std::mutex one_at_a_time;  // reading and reporting
    std::size_t done = 0;
    inArena(common.threads, [&] {
        tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t k) {
            Stretch& stretch = all.stretches[k];
            stretch.from = tasks[k].from, stretch.to = tasks[k].goals.back().time;
            std::optional<FullFrame> full;
            if (tasks[k].full) {
                const std::lock_guard lock(one_at_a_time);
                auto read = reader.full(*tasks[k].full);
                if (!read) {
                    stretch.fault = formats::format(read.errors().front());
                    return;
                }
                full = std::move(*read);
            }
            if (!stopRequested()) follow(scenario.model, std::move(full), tasks[k], stretch);
            const std::lock_guard lock(one_at_a_time);
            if (show)
                show({"verify", static_cast<double>(++done) / static_cast<double>(tasks.size()),
                      std::to_string(done) + " of " + std::to_string(tasks.size()) + " stretches"});
        });
    });
    for (const Stretch& stretch : all.stretches) all.frames += stretch.frames;
    all.interrupted = stopRequested();
    return all;
}

}  // namespace talus::tools
