#include "analysis/history_range.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/load_search.h"
#include "analysis/probing.h"
#include "law/law.h"
#include "state/caller.h"
#include "state/incidence.h"

namespace talus::analysis {
namespace {

constexpr std::int64_t kNoDifference = 2;  // [cells] answers as near as that are the same
constexpr double kShareBeforeRange = 0.9;  // of the progress of the whole
constexpr double kWorthAWarning = 0.01;    // of the answer
constexpr double kFarEnough = 0.5;         // of the answer: no farther is looked
constexpr double kLocks = 1.0;             // tan(phi) from which blocks that lean on each other may lock

/// Loads that are brought on afresh, on the search's own cells.
class Afresh {
 public:
    Afresh(const State& built, const LoadAxis& axis, const Control& control, const QuasiStatic& settings,
           bool parallel)
        : axis_(axis), control_(control), unloaded_(built) {
        work_ = prepare(unloaded_, settings, control_, axis.imbalance_tolerance, parallel);
        work_.leaves_few = true;  // nothing has slid
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

/// \return whether some friction was more than that from which blocks lock; strength curves stay as they are
bool limitFriction(std::vector<contact::JointLaw>& laws) {
    bool any = false;
    for (contact::JointLaw& law : laws) {
        if (law.curved) continue;
        any = any || law.tan_friction > kLocks;
        law.tan_friction = std::min(law.tan_friction, kLocks);
        law.residual_tan_friction = std::min(law.residual_tan_friction, kLocks);
    }
    return any;
}

/// The answer with no more friction than that; nothing where there is no more, blocks slide, or none is found.
std::optional<double> answerWithoutLocking(const State& built, const LoadAxis& axis, const Control& control,
                                           const QuasiStatic& settings, bool parallel,
                                           const SearchResult& result) {
    State state = built;
    axis.apply(state, result.low);
    if (result.mode == FailureMode::sliding || !limitFriction(state.laws)) return std::nullopt;
    state = built;
    limitFriction(state.laws);
    LoadAxis limited = axis;
    limited.apply = [&axis](State& at, double load) {
        axis.apply(at, load);
        limitFriction(at.laws);
    };
    const SearchResult found = searchLoad(state, limited, control, settings, parallel).result;
    if (found.status != SearchStatus::found || !found.confirmed) return std::nullopt;
    return found.answer;
}

/// Whether the assembly stands at a load when strength is reduced there to the joints' own, from the strongest; nothing where
/// that is not known.
std::optional<bool> standsReduced(const State& built, const LoadAxis& axis, double load,
                                  const Control& control, const QuasiStatic& settings, bool parallel) {
    State state = built;
    axis.apply(state, load);
    LoadAxis reduced = strengthAxis(built.geometry->model);
    const double own = 1 / reduced.unit;
    if (own <= reduced.start) return std::nullopt;
    reduced.stop = static_cast<std::int64_t>(std::ceil((own - reduced.start) / reduced.cell));
    reduced.apply = [own, apply = reduced.apply](State& at, double factor) {
        apply(at, std::min(factor, own));
    };
    const SearchResult found = searchLoad(state, reduced, control, settings, parallel).result;
    if (found.status == SearchStatus::stable_to_stop) return true;
    const bool fails = found.status == SearchStatus::found || found.status == SearchStatus::unstable_at_start;
    return fails && found.confirmed ? std::optional(false) : std::nullopt;
}

/// The load up to which the assembly stands so, where it is less than another one by what is worth a warning. Blocks that lean on
/// each other press low ones that slide between them, and may stand by it where rougher joints let the first one topple.
std::optional<double> answerByReduction(const State& built, const LoadAxis& axis, const Control& control,
                                        const QuasiStatic& settings, bool parallel,
                                        const SearchResult& result, double below) {
    if (axis.strongest_at_start || result.mode == FailureMode::sliding) return std::nullopt;
    const double margin =
        std::max(static_cast<double>(kNoDifference) * axis.cell, kWorthAWarning * std::abs(result.answer));
    double stands = axis.start, fails = below - margin;
    if (fails <= stands) return std::nullopt;
    const auto stands_at = [&](double load) {
        return standsReduced(built, axis, load, control, settings, parallel);
    };
    if (stands_at(fails).value_or(true)) return std::nullopt;
    while (fails - stands > margin) {
        const double middle = 0.5 * (stands + fails);
        const std::optional<bool> there = stands_at(middle);
        if (!there) return std::nullopt;
        (*there ? stands : fails) = middle;
    }
    return 0.5 * (stands + fails);
}

/// The answer of another way, in words.
struct OtherAnswer {
    double load;
    std::string way;     ///< after the load
    std::string advice;  ///< when not to count on the lower end
};

void addOthers(const LoadAxis& axis, const std::vector<OtherAnswer>& others, SearchResult& result) {
    double low = result.answer, high = result.answer;
    std::string said;
    const OtherAnswer* lowest = nullptr;
    for (const OtherAnswer& other : others) {
        if (other.load < low) lowest = &other;
        low = std::min(low, other.load);
        high = std::max(high, other.load);
        said += ", " + axis.say(other.load) + " " + other.way;
    }
    result.range = {low, high};
    result.range_reason = "friction remembers how a load was reached: " + axis.say(result.answer) +
                          " when it grows step by step" + said;
    const double below = result.answer - low, whole = std::abs(result.answer);
    if (lowest == nullptr || below <= kWorthAWarning * whole) return;
    const std::string share = below < whole ? ", " + formatted("%.0f", 100 * below / whole) + " % below" : "";
    result.warnings.push_back("the answer is above the lower end of its range: " + lowest->way +
                              " the assembly fails at " + axis.say(low) + share +
                              "; count on the lower end unless " + lowest->advice);
}

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
    quiet.keep_failing_state = false;
    quiet.most_work = mostWorkBeside(result);
    Afresh afresh(built, axis, quiet, settings, parallel);
    const auto answer = static_cast<std::int64_t>(std::llround((result.low - axis.start) / axis.cell));
    const auto farthest = static_cast<std::int64_t>(kFarEnough * std::abs(result.answer) / axis.cell);
    const auto last = afresh.lastStable(answer, farthest);
    std::vector<OtherAnswer> others;
    if (!last) {
        result.range_reason =
            "another loading history (weight brought on at that load) gives no equilibrium near the answer";
    } else if (std::abs(*last - answer) <= kNoDifference) {
        result.range_reason = "weight brought on at that load fails in the same place";
    } else {
        others.push_back({0.5 * (axis.load(*last) + axis.load(*last + 1)),
                          "with weight brought on at that load", "the load grows as the search has it"});
    }
    const auto unlocked = answerWithoutLocking(built, axis, quiet, settings, parallel, result);
    if (unlocked && std::abs(*unlocked - result.answer) > static_cast<double>(kNoDifference) * axis.cell)
        others.push_back({*unlocked, "with friction of no more than 45 degrees", "joints are known to lock"});
    double lowest = result.low;
    for (const OtherAnswer& other : others) lowest = std::min(lowest, other.load);
    std::optional<double> reduced;
    if (points <= control.most_points_of_range / kDearerThanRange)
        reduced = answerByReduction(built, axis, quiet, settings, parallel, result, lowest);
    if (reduced)
        others.push_back(
            {*reduced, "with strength reduced at that load", "the joints have never been stronger than now"});
    if (afresh.stopped()) {
        result.range_reason = "interrupted";
    } else if (!others.empty()) {
        addOthers(axis, others, result);
    }
}

}  // namespace talus::analysis
