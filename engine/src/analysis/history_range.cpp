#include "analysis/history_range.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/probing.h"
#include "state/caller.h"
#include "state/incidence.h"

namespace talus::analysis {
namespace {

constexpr std::int64_t kNoDifference = 2;  // [cells] answers as near as that are the same
constexpr double kShareBeforeRange = 0.9;  // of the progress of the whole
constexpr double kWorthAWarning = 0.01;    // of the answer
constexpr double kFarEnough = 0.5;         // of the answer: no farther is looked

/// Loads that are brought on afresh, on the search's own cells.
class Afresh {
 public:
    Afresh(const State& built, const LoadAxis& axis, const Control& control, const QuasiStatic& settings,
           bool parallel)
        : axis_(axis), control_(control), unloaded_(built) {
        work_ = prepare(unloaded_, settings, control_, axis.imbalance_tolerance, parallel);
        unloaded_.load.gravity_share = unloaded_.load.water_share = 0;
    }

    bool stands(std::int64_t cell) {
        State state = unloaded_;
        axis_.apply(state, axis_.load(cell));
        state.load.gravity_share = 1;
        if (!rests(state)) return false;
        if (!state.geometry->model.hasWater()) return true;
        state.load.water_share = 1;
        return rests(state);
    }

    /// The last cell at which an equilibrium is found, going from `cell` in strides that double; nothing when there is none
    /// as far as is looked.
    std::optional<std::int64_t> lastStable(std::int64_t cell, std::int64_t farthest) {
        const bool up = stands(cell);
        std::int64_t low = cell, high = cell;
        for (std::int64_t stride = 1; !stopped(); stride *= 2) {
            if (stride > farthest) return up ? std::optional(low) : std::nullopt;
            const std::int64_t next = up ? cell + stride : cell - stride;
            if (next < 0) return std::nullopt;
            const bool stable = stands(next);
            (stable ? low : high) = next;
            if (stable != up) return between(low, high);
        }
        return std::nullopt;
    }

    bool stopped() const { return isStopped(control_); }

 private:
    bool rests(State& state) { return findRest(state, work_, kMostFactors).verdict == Verdict::stable; }

    /// To an eighth of what they are apart.
    std::int64_t between(std::int64_t low, std::int64_t high) {
        const std::int64_t fine = std::max<std::int64_t>(1, (high - low) / 8);
        while (high - low > fine && !stopped()) {
            const std::int64_t middle = low + (high - low) / 2;
            (stands(middle) ? low : high) = middle;
        }
        return low;
    }

    const LoadAxis& axis_;
    const Control& control_;
    State unloaded_;
    QuasiStaticWork work_;
};

}  // namespace

void addHistoryRange(const State& built, const LoadAxis& axis, const Control& control,
                     const QuasiStatic& settings, bool parallel, SearchResult& result) {
    if (result.status != SearchStatus::found) return;
    if (!result.let_go.empty()) {
        result.range_reason = "another loading history would not let the same blocks go before";
        return;
    }
    const std::size_t points = countContacts(built.interfaces).points;
    if (points > control.most_points_of_range) {
        result.range_reason = "the model has " + std::to_string(points) + " contact points; up to " +
                              std::to_string(control.most_points_of_range) +
                              " another loading history is tried without being asked for";
        return;
    }
    if (control.progress)
        control.progress({"another loading history", kShareBeforeRange, axis.say(result.answer)});
    Control quiet = control;
    quiet.progress = {};
    Afresh afresh(built, axis, quiet, settings, parallel);
    const auto answer = static_cast<std::int64_t>(std::llround((result.low - axis.start) / axis.cell));
    const auto farthest = static_cast<std::int64_t>(kFarEnough * std::abs(result.answer) / axis.cell);
    const auto last = afresh.lastStable(answer, farthest);
    if (afresh.stopped()) {
        result.range_reason = "interrupted";
    } else if (!last) {
        result.range_reason =
            "another loading history (weight brought on at that load) gives no equilibrium near the answer";
    } else if (std::abs(*last - answer) <= kNoDifference) {
        result.range_reason = "weight brought on at that load fails in the same place";
    } else {
        const double other = 0.5 * (axis.load(*last) + axis.load(*last + 1));
        result.range = std::minmax(result.answer, other);
        result.range_reason = "friction remembers how a load was reached: " + axis.say(result.answer) +
                              " when it grows step by step, " + axis.say(other) +
                              " when weight is brought on at that load";
        const double below = (result.answer - other) / std::abs(result.answer);
        if (below > kWorthAWarning)
            result.warnings.push_back(
                "the answer is the upper end of its range: with weight brought on at that load the "
                "assembly fails at " +
                axis.say(other) + ", " + formatted("%.0f", 100 * below) +
                " % below; count on the lower end unless the load grows as the search has it");
    }
}

}  // namespace talus::analysis
