#include "analysis/search_of_the_rest.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "analysis/history_range.h"
#include "analysis/initial_state.h"
#include "analysis/load_search.h"
#include "analysis/loose_blocks.h"
#include "analysis/plausible.h"
#include "analysis/stopwatch.h"
#include "analysis/threads.h"
#include "analysis/water_warnings.h"
#include "build/build.h"
#include "law/joint_laws.h"
#include "state/caller.h"
#include "step/time_step.h"
#include "talus/searches.h"

namespace talus::analysis {
namespace {

constexpr int kAttempts = 3;  // with half the time step and longer windows, when a failure is not confirmed
constexpr int kAttemptsAtStart = 2;
constexpr double kMorePatience = 3.0;

bool claimsFailure(const SearchResult& result) {
    return result.status == SearchStatus::found || result.status == SearchStatus::unstable_at_start;
}

/// A failure that the continuation with true inertia does not bear out was one of the numbers (contacts that chatter
/// at too long a step, a mode far slower than its estimate): the search is made again with half the step and longer
/// windows, and is undecided if that does not help.
Outcome searchConfirmed(const State& state, const LoadAxis& axis, Control control, QuasiStatic settings,
                        bool parallel) {
    Effort before;
    const std::int64_t most_work = control.most_work;
    for (int attempt = 1;; ++attempt) {
        if (most_work > 0)
            control.most_work = std::max<std::int64_t>(1, most_work - workOf(before.steps, before.factors));
        Outcome outcome = searchLoad(state, axis, control, settings, parallel);
        SearchResult& result = outcome.result;
        addEffort(before, result);
        if (!claimsFailure(result) || result.confirmed) return outcome;
        if (isStopped(control)) {
            result.status = SearchStatus::interrupted;
            return {std::move(result), {}};
        }
        if (!outcome.restless.empty() ||
            attempt == (result.status == SearchStatus::found ? kAttempts : kAttemptsAtStart)) {
            result.status = SearchStatus::undecided;
            result.warnings.push_back(
                "the failing motion is not borne out by the continuation with true inertia");
            return {std::move(result), {}, std::move(outcome.restless)};
        }
        before = effortOf(result);
        settings.step_safety *= 0.5;
        settings.watch_periods *= kMorePatience;
    }
}

void warnOfFreeBlocks(State& state) {
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        if (state.blocks.motion[b] == Motion::free && !touchesSomething(state, b)) {
            state.warnings.push_back("block \"" + state.geometry->model.blocks[b].name +
                                     "\" touches no other block at the start");
            return;
        }
}

/// From the search's loads to those of the answer.
void putInUnits(double unit, SearchResult& result) {
    if (unit == 1) return;
    for (double* load : {&result.low, &result.high, &result.answer}) *load *= unit;
    for (BlockGroup& group : result.let_go)
        for (double* load : {&group.factor, &group.low, &group.high}) *load *= unit;
    if (result.range) result.range = {unit * result.range->first, unit * result.range->second};
    for (Probe& probe : result.probes) probe.load *= unit;
    if (result.failing) {
        auto failing = std::make_shared<FailingState>(*result.failing);
        failing->load *= unit;
        result.failing = std::move(failing);
    }
}

/// Searches, and searches again without the blocks that fall at the start whatever the strength.
class SearchOfTheRest {
 public:
    /// \param without blocks that are not to take part
    SearchOfTheRest(const Model& model, const LoadAxis& axis, const Control& control,
                    const QuasiStatic& settings, const std::vector<std::string>& without)
        : model_(model),
          axis_(axis),
          control_(control),
          settings_(settings),
          gone_(blocksNamed(model, without)) {}

    Result<SearchResult> run() {
        Effort before;
        for (;;) {
            Result<State> built = buildState(left(), control_.threads != 1, control_);
            if (isStopped(control_)) return notBegun(before);
            if (!built) return built.errors();
            const bool parallel = worthThreads(*built, control_.threads);
            const std::vector<double> bounds = frequencyBounds(*built, parallel);
            const std::vector<std::size_t> splinters =
                splintersOfRounding(*built, axis_.imbalance_tolerance, bounds);
            if (letGo(splinters)) {
                rounded_ += splinters.size();
                continue;
            }
            std::vector<Error> errors = implausibleSearch(*built, axis_.imbalance_tolerance, bounds);
            if (!errors.empty()) return errors;
            for (std::string& doubt : doubts(*built)) built->warnings.push_back(std::move(doubt));
            warnOfFreeBlocks(*built);
            Outcome outcome = searchConfirmed(*built, axis_, control_, settings_, parallel);
            if (letGo(outcome.restless)) {
                before += effortOf(outcome.result);
                restless_ += outcome.restless.size();
                continue;
            }
            if (outcome.result.status == SearchStatus::unstable_at_start && !axis_.strongest_at_start)
                outcome.falling = fallingAtStrongest(*built, parallel, before);
            addEffort(before, outcome.result);
            if (outcome.result.status == SearchStatus::unstable_at_start)
                if (auto pushed = pushedByWater(*built, outcome.falling))
                    warnings_.push_back(std::move(*pushed));
            if (outcome.result.status != SearchStatus::unstable_at_start ||
                !(letGo(outcome.falling) || letSmallGo(outcome.result)))
                return withRange(*built, parallel, named(std::move(outcome.result)));
            before = effortOf(outcome.result);
        }
    }

 private:
    /// Nothing is known.
    SearchResult notBegun(const Effort& before) const {
        SearchResult result;
        result.status = SearchStatus::interrupted;
        result.low = -kInfinity;
        result.high = kInfinity;
        result.blocks = model_.blocks.size();
        setEffort(before, result);
        return named(std::move(result));
    }

    SearchResult withRange(const State& built, bool parallel, SearchResult result) const {
        if (control_.most_points_of_range > 0)
            addHistoryRange(built, axis_, control_, settings_, parallel, result);
        return result;
    }

    std::shared_ptr<const Model> left() const {
        const bool all = std::find(gone_.begin(), gone_.end(), 1) == gone_.end();
        return all ? keptByCaller(model_) : std::make_shared<const Model>(withoutBlocks(model_, gone_));
    }

    std::vector<std::size_t> fallingAtStrongest(State strong, bool parallel, Effort& effort) const {
        strong.laws = jointLaws(model_.joints, strongestFactor(model_.joints));
        Start start = loadStart(strong, axis_, control_, settings_, parallel);
        effort += start.effort;
        return std::move(start.falling);
    }

    /// Takes out what falls, counted in blocks that are left. False when there is nothing, or too much for loose
    /// blocks.
    bool letGo(const std::vector<std::size_t>& falling) {
        if (falling.empty() || isStopped(control_)) return false;
        std::vector<char> loose = loose_.empty() ? std::vector<char>(gone_.size(), 0) : loose_;
        std::size_t left = 0;
        auto next = falling.begin();
        for (std::size_t b = 0; b < gone_.size() && next != falling.end(); ++b) {
            if (gone_[b] || left++ != *next) continue;
            loose[b] = 1;
            ++next;
        }
        if (looseShare(model_, loose) > kMostLoose) return false;
        loose_ = std::move(loose);
        for (std::size_t b = 0; b < gone_.size(); ++b) gone_[b] = gone_[b] || loose_[b];
        return true;
    }

    /// Of a failure at the start that has less mass than an answer, of what is in the search. False where what is left would have
    /// less, too.
    bool letSmallGo(const SearchResult& result) {
        const double least = model_.analysis.least_mass_share * (1 - looseShare(model_, gone_));
        if (!result.confirmed || isStopped(control_)) return false;
        std::vector<char> going = blocksNamed(model_, result.moving_blocks);
        if (looseShare(model_, going) >= least) return false;
        for (std::size_t b = 0; b < gone_.size(); ++b) going[b] = going[b] || gone_[b];
        if (1 - looseShare(model_, going) < least) return false;
        gone_ = std::move(going);
        let_go_.push_back({.factor = result.high, .blocks = result.moving_blocks});
        return true;
    }

    SearchResult named(SearchResult result) const {
        result.let_go.insert(result.let_go.begin(), let_go_.begin(), let_go_.end());
        if (!result.let_go.empty()) result.failing = nullptr;  // its blocks are not the model's
        result.warnings.insert(result.warnings.end(), warnings_.begin(), warnings_.end());
        for (std::size_t b = 0; b < loose_.size(); ++b)
            if (loose_[b]) result.fallen_at_start.push_back(model_.blocks[b].name);
        std::sort(result.fallen_at_start.begin(), result.fallen_at_start.end());
        if (result.fallen_at_start.empty()) return result;
        result.failing = nullptr;  // its blocks are not the model's
        const std::size_t all = result.fallen_at_start.size(), splinters = restless_ + rounded_;
        std::string what = splinters < all ? " fall at the start whatever the strength" : "";
        if (splinters > 0) {
            what += std::string(what.empty() ? "" : ", or") +
                    " are splinters that come neither to rest nor fall or that rounding would move";
            if (splinters < all) what += ", " + std::to_string(splinters) + " of them";
        }
        result.warnings.push_back(std::to_string(all) + " of the blocks" + what + " (" +
                                  result.fallen_at_start.front() +
                                  " for one): the answer is for the rest, without them");
        return result;
    }

    const Model& model_;
    const LoadAxis& axis_;
    const Control& control_;
    const QuasiStatic& settings_;
    std::vector<char> gone_;            ///< per block: not in the search
    std::vector<char> loose_{};         ///< per block: because it falls; empty: none
    std::vector<BlockGroup> let_go_{};  ///< failed at the start and had too little mass to be the answer
    std::size_t restless_ = 0;          ///< of those: taken out because they come neither to rest nor fall
    std::size_t rounded_ = 0;           ///< of those: so small that rounding is a part of their weight
    std::vector<std::string> warnings_{};
};

}  // namespace

Result<SearchResult> searchOfTheRest(const Model& model, const LoadAxis& axis, const Control& control,
                                     const QuasiStatic& settings, const std::vector<std::string>& without) {
    return inArena(control.threads, [&]() -> Result<SearchResult> {
        const Stopwatch all;
        Result<SearchResult> result = SearchOfTheRest(model, axis, control, settings, without).run();
        if (!result) return result;
        putInUnits(axis.unit, *result);
        result->wall_seconds = all.seconds();
        return result;
    });
}

void addGroups(const Model& model, const LoadAxis& axis, const Control& control, const QuasiStatic& settings,
               SearchResult& result) {
    if (result.status != SearchStatus::found) return;
    result.groups.push_back({.factor = result.answer, .blocks = result.moving_blocks});
    std::vector<std::string> gone = leftOut(result);
    const auto goes = [&](const std::vector<std::string>& blocks) {
        gone.insert(gone.end(), blocks.begin(), blocks.end());
    };
    goes(result.moving_blocks);
    const auto free = static_cast<std::size_t>(
        std::count_if(model.blocks.begin(), model.blocks.end(),
                      [](const Block& block) { return block.motion == Motion::free; }));
    while (static_cast<int>(result.groups.size()) < control.groups && gone.size() < free &&
           !isStopped(control)) {
        const Result<SearchResult> next = searchOfTheRest(model, axis, control, settings, gone);
        if (!next) return;
        addEffort(effortOf(*next), result);
        result.wall_seconds += next->wall_seconds;
        const std::vector<std::string> before_next = leftOut(*next);
        BlockGroup& last = result.groups.back();
        last.blocks.insert(last.blocks.end(), before_next.begin(), before_next.end());
        std::sort(last.blocks.begin(), last.blocks.end());
        result.groups_undecided = next->status == SearchStatus::undecided;
        if (result.groups_undecided)
            result.warnings.push_back("the search for the blocks that go after those is undecided");
        if (!claimsFailure(*next) || next->moving_blocks.empty()) return;
        const double factor = next->status == SearchStatus::found ? next->answer : last.factor;
        result.groups.push_back({.factor = std::max(factor, last.factor), .blocks = next->moving_blocks});
        goes(before_next);
        goes(next->moving_blocks);
    }
}

}  // namespace talus::analysis
