#include "search/path_follower.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "equilibrium/release.h"
#include "forces/sum.h"
#include "state/block_motion.h"

namespace talus::search {
namespace {

using equilibrium::Arc;
using equilibrium::EquilibriumPath;
using equilibrium::Parting;
using equilibrium::PathStep;
using equilibrium::Released;

constexpr int kMostPathSteps = 4'000;
constexpr double kShortOfTarget = 0.9;
constexpr std::int64_t kLeastWorkBeyond = 60;  // factorisations
constexpr double kLeastGrowth = 0.5, kMostGrowth = 2;

class Follower {
 public:
    Follower(EquilibriumPath& path, const LoadAxis& axis, const Follow& follow)
        : path_(path),
          axis_(axis),
          follow_(follow),
          rules_(path.rules()),
          cell_(axis.loading.cell),
          rise_(follow.rise > 0 ? follow.rise : rules_.rise * cell_) {
        noted_ = path.work().factors;
        begin_position_ = path.state().blocks.position;
        begin_orientation_ = path.state().blocks.orientation;
        found_.by_displacement.resize(follow.displacements.size());
        found_.bracket = {path.load(), path.load()};
        beginAnew();
        note(Verdict::stable);
    }

    Followed run() {
        for (int k = 0; k < kMostPathSteps; ++k) {
            if (path_.stopped()) return ended(PathResult::interrupted);
            if (const auto result = look()) return ended(*result);
            mended_ = false;
            if (follow_.target - path_.load() <= cell_) {
                if (const auto result = toTarget()) return ended(*result);
                continue;
            }
            if (stepAlong()) continue;
            if (const auto result = leapOver()) return ended(*result);
        }
        return ended(PathResult::lost);
    }

 private:
    /// The arc of the next step, and the start of parting: after a beginning, a leap, or removed blocks.
    void beginAnew() {
        arc_.displacement = rules_.first_step * rules_.step_displacement;
        arc_.load = rules_.first_step * longest();
        slow_ = 0;
        creep_.reset();
        countFromHere();
    }
    void countFromHere() {
        peak_ = path_.load();
        highest_ = peak_;
        since_ = path_.parting();
        stood_ = path_.place();
    }

    /// At least 1: a step is shorter than the last only where Newton's method converged slowly or blocks moved far.
    double longerThanLast() const { return std::max(1.0, rules_.longer_than_last); }
    double longest() const {
        // Steps end a little beside their arcs, and none may go beyond the target.
        const double left = kShortOfTarget * (follow_.target - path_.load());
        return std::min(axis_.longest(path_.load()), std::max(left, kShortOfTarget * cell_));
    }

    /// Records where the path is, and what has failed by now. \return the result, when that is known
    std::optional<PathResult> look() {
        const double load = path_.load();
        if (load > highest_) {
            highest_ = load;
            stood_ = path_.place();
        }
        if (const auto result = creeps()) return result;
        if (load > peak_ + rise_ && !creep_) {
            peak_ = load;
            since_ = path_.parting();
        }
        return std::nullopt;
    }

    /// Blocks that slide far beyond the failure displacement while the load hardly rises failed where that
    /// began: their resistance hardens, as that of bolts across a slide. Columns that lean on soft joints
    /// move as slowly and are stable: elastic displacement is no sliding.
    std::optional<PathResult> creeps() {
        if (!creep_) return std::nullopt;
        const double slid = path_.slidSince(creep_->since);
        if (risesFast(path_.load() - creep_->stood.load, slid)) {
            creep_.reset();
            return std::nullopt;
        }
        if (slid <= rules_.creep + allowance()) return std::nullopt;
        highest_ = creep_->stood.load;
        stood_ = creep_->stood;
        since_ = creep_->since;
        return fails(path_.partedSince(since_), allowance(), highest_ + rules_.overload * cell_);
    }

    /// Whether the load, at the rate of this step, rises by `rise_` before neighbours slide by the failure
    /// displacement. The step itself may slide farther.
    bool risesFast(double gain, double slid) const {
        const double share = (follow_.displacements[follow_.counts] + allowance()) / slid;
        return !(gain * share < rise_);
    }

    /// \param parted  neighbours since the load last rose [median block sizes]
    /// \param gives   of that, what joints and bolts give
    /// \param load    at which they leave
    std::optional<PathResult> fails(double parted, double gives, double load) {
        parted -= gives;
        while (next_ < follow_.displacements.size() && parted > follow_.displacements[next_]) {
            const std::size_t k = next_++;
            found_.by_displacement[k] = Bracket{highest_, load};
            if (found_.failing && isSameMotion(load)) found_.failing = path_.exactState();
            if (k != follow_.counts) continue;
            found_.bracket = {highest_, load};
            found_.failing = path_.exactState();
            found_.stood = stood_;
            found_.since = since_;
            note(Verdict::failing);
            if (follow_.mends && follow_.mends(found_)) {
                next_ = 0;
                std::fill(found_.by_displacement.begin(), found_.by_displacement.end(), std::nullopt);
                found_.failing.reset();
                found_.stood.reset();
                beginAnew();
                mended_ = true;
                return std::nullopt;
            }
            factors_ = path_.work().factors;
        }
        if (next_ == follow_.displacements.size()) return PathResult::failed;
        if (found_.failing && mostFactors() <= 0) return PathResult::failed;
        return std::nullopt;
    }

    /// Whether the farther parting is the same failure, observed longer.
    bool isSameMotion(double load) const { return load <= found_.bracket.fails; }

    /// Elastic displacement of joints and bolts: no part of a failure [median block sizes].
    double allowance() const {
        return (rules_.elastic_parting * path_.elasticDisplacement() + tieReach(path_.state())) /
               path_.state().geometry->length_scale;
    }

    /// \return whether the path has advanced; else a shorter step is to be tried
    bool stepAlong() {
        if (slow_ >= static_cast<int>(rules_.slow_steps)) return false;
        if (follow_.report) follow_.report(path_.load(), "stands");
        const Parting before = path_.parting();
        const std::int64_t factors = path_.work().factors;
        arc_.load = std::min(arc_.load, longest());
        PathStep step = path_.along(arc_);
        if (!step) return false;
        if (step.value < 0) {
            return !isPeakKnown(step);
        }
        const double length = path_.norm(step), gain = step.value;
        const int iterations = step.iterations;
        before_ = path_.place();
        path_.commit(std::move(step));
        // After new contacts, bonds overloaded by the step, or with new pressure of coupled flow, equilibrium
        // is needed again at its load.
        if ((path_.bondsGive() || !path_.isBalanced() || path_.renewPressure()) && !settle()) {
            const bool is_known = gain <= rules_.peak_accuracy * cell_;
            // On the way to an equilibrium, coupled flow and opening of the joints do not agree.
            const bool is_coupled = !path_.state().coupled_pressure.push.empty();
            if (!is_known || is_coupled) path_.goBack(*before_);
            if (is_known) return false;
            arc_.displacement = rules_.shorter_at_peak * length;
            arc_.load = rules_.shorter_at_peak * gain;
            return true;
        }
        const double parted = path_.partedSince(before);
        if (!creep_ &&
            !risesFast(gain, path_.slidSince(before))) {  // the load where it began is refined like a peak
            if (gain > rules_.peak_accuracy * cell_ && length > kTooShort) {
                path_.goBack(*before_);
                arc_.displacement = rules_.shorter_at_peak * length;
                arc_.load = std::max(rules_.shorter_at_peak * gain, rules_.peak_accuracy * cell_);
                return true;
            }
            creep_ = Creep{*before_, before};
        }
        double growth = std::clamp(rules_.wanted_iterations / iterations, kLeastGrowth, kMostGrowth);
        const auto work = static_cast<double>(path_.work().factors - factors);
        const bool is_slow = growth < 1 && gain < rules_.slow_gain * cell_ * work &&
                             parted < rules_.slow_parting * follow_.displacements[follow_.counts];
        slow_ = is_slow ? slow_ + 1 : 0;
        if (parted > 0) growth = std::min(growth, rules_.step_displacement / parted);
        arc_.displacement =
            std::max(longerThanLast() * growth * length, rules_.shorter_start * arc_.displacement);
        arc_.load = std::clamp(longerThanLast() * growth * std::abs(gain), rise_, std::max(longest(), rise_));
        note(Verdict::stable);
        return true;
    }

    /// A step along which the load falls contains a peak, or begins beyond one that the previous step passed.
    /// A concave path lies below its tangents.
    /// \return whether the peak is known well enough; else the next step is a shorter one
    bool isPeakKnown(const PathStep& step) {
        const PathStep& last = path_.last();
        const double accuracy = rules_.peak_accuracy * cell_;
        if (last.x.empty() || last.unknown != equilibrium::Unknown::load) return true;
        const double length = path_.norm(step), last_length = path_.norm(last);
        if (last.value / last_length * length <= accuracy) return true;
        if (length < kTooShort) return true;
        if (before_ && last.value > accuracy && length < rules_.shorter_at_peak * last_length) {
            path_.goBack(*before_);
            before_.reset();
            arc_.displacement = rules_.shorter_at_peak * last_length;
            arc_.load = std::max(rules_.shorter_at_peak * last.value, rise_);
            return false;
        }
        arc_.displacement = rules_.shorter_at_peak * length;
        arc_.load = std::max(rules_.shorter_at_peak * std::abs(step.value), rise_);
        return false;
    }

    /// Finds equilibrium at the load that the path has. \return whether there is one within reach
    bool settle() {
        return release(path_, path_.load(), since_, farthest() + allowance(), is_work_done_) ==
               Released::rests;
    }

    /// Where steps along the path gain nothing, or do not converge, the assembly is released at a slightly
    /// higher load.
    std::optional<PathResult> leapOver() {
        const double load = std::max(path_.load(), highest_) + leap_;
        if (follow_.report) follow_.report(load, "released");
        const auto place = path_.place();
        const Parting since = since_;
        const double gives = allowance();
        Released released = equilibrium::release(path_, load, since, farthest() + gives, is_work_done_);
        if (path_.stopped()) return PathResult::interrupted;
        const double parted = path_.partedSince(since) - gives;
        const bool is_near = released == Released::rests && parted <= follow_.displacements[follow_.counts];
        if (released == Released::lost && parted <= follow_.displacements[follow_.counts]) {
            // Newton's method may converge at a slightly higher load; the bracket is as much wider.
            if (leap_ >= kMostLeap * cell_) return PathResult::lost;
            path_.goBack(place);
            least_leap_ = leap_ = 2 * leap_;
            return std::nullopt;
        }
        if (!is_near && leap_ > kSameLeap * least_leap_) {  // too far: less load
            path_.goBack(place);
            leap_ = std::max(least_leap_, rules_.shorter_at_peak * leap_);
            return std::nullopt;
        }
        const std::size_t known = next_;
        const bool was_known = found_.failing.has_value();
        if (const auto result = fails(path_.partedSince(since), gives, load)) return result;
        if (!was_known && found_.failing && next_ > known && released == Released::left) {  // and farther
            released = equilibrium::release(path_, load, since, farthest() + gives, is_work_done_);
            if (path_.stopped()) return PathResult::interrupted;
            if (const auto result = fails(path_.partedSince(since), gives, load)) return result;
        }
        if (std::exchange(mended_, false)) return std::nullopt;
        if (released != Released::rests) return PathResult::failed;
        if (found_.failing && mostFactors() <= 0) return PathResult::failed;
        leap_ *= 2;
        least_leap_ = rules_.overload * cell_;
        const double highest = highest_;
        beginAnew();
        if (next_ > known) since_ = since, peak_ = highest;
        return std::nullopt;
    }

    /// How far a release is followed: to the failure that counts, then farther.
    double farthest() const {
        return found_.failing ? follow_.displacements.back() : follow_.displacements[follow_.counts];
    }
    /// Beyond the failure that counts the path is followed with a quarter of the work that has been done.
    std::int64_t mostFactors() const {
        if (!found_.failing) return std::numeric_limits<std::int64_t>::max();
        return factors_ +
               std::max(kLeastWorkBeyond,
                        static_cast<std::int64_t>(rules_.work_beyond * static_cast<double>(factors_))) -
               path_.work().factors;
    }

    /// The last piece, at the target's own load.
    std::optional<PathResult> toTarget() {
        const Parting since = since_;
        const double gives = allowance();
        const Released released =
            equilibrium::release(path_, follow_.target, since, follow_.displacements[follow_.counts] + gives);
        if (path_.stopped()) return PathResult::interrupted;
        highest_ = path_.load();
        if (released == Released::rests) {
            stood_ = path_.place();
            note(Verdict::stable);
            return PathResult::reached;
        }
        if (released == Released::lost) return PathResult::lost;
        if (const auto result = fails(path_.partedSince(since), gives, follow_.target)) return *result;
        if (std::exchange(mended_, false)) return std::nullopt;
        return PathResult::failed;
    }

    void note(Verdict verdict) {
        const State& state = path_.state();
        const double displacement = largestMotion(state, begin_position_, begin_orientation_);
        const std::int64_t factors = path_.work().factors;
        Probe probe;
        probe.load = path_.load();
        probe.verdict = verdict;
        probe.factors = factors - noted_;
        probe.out_of_balance = path_.outOfBalance();
        probe.displacement = displacement;
        noted_ = factors;
        found_.probes.push_back(std::move(probe));
        found_.points.push_back({path_.load(), displacement});
    }

    Followed ended(PathResult result) {
        if (found_.failing && result != PathResult::interrupted) result = PathResult::failed;
        found_.result = result;
        if (!found_.stood) found_.stood = std::move(stood_);
        if (result != PathResult::failed) found_.bracket = {highest_, kInfinity};
        return std::move(found_);
    }

    static constexpr double kTooShort = 1e-9;  // an arc that rounding would decide
    static constexpr double kMostLeap = 4;     // cells, beyond which a search is undecided
    static constexpr double kSameLeap = 1.04;  // but for rounding

    EquilibriumPath& path_;
    const LoadAxis& axis_;
    const Follow& follow_;
    const SearchRules& rules_;
    const double cell_, rise_;
    PositionArray begin_position_{};
    QuaternionArray begin_orientation_{};
    Parting since_{};
    double peak_ = 0, highest_ = 0;
    Arc arc_{};
    double leap_ = rules_.overload * cell_, least_leap_ = leap_;
    int slow_ = 0;
    bool mended_ = false;   ///< mended by the caller: the path is in equilibrium again
    std::size_t next_ = 0;  ///< the least displacement not yet reached
    std::int64_t factors_ = 0, noted_ = 0;
    std::optional<EquilibriumPath::Place> stood_{}, before_{};
    /// Where the load began to rise slowly.
    struct Creep {
        EquilibriumPath::Place stood;
        Parting since;
    };
    std::optional<Creep> creep_{};
    const std::function<bool()> is_work_done_ = [this] { return mostFactors() < 0; };  ///< for releases
    Followed found_{};
};

}  // namespace

Followed followPath(EquilibriumPath& path, const LoadAxis& axis, const Follow& follow) {
    return Follower(path, axis, follow).run();
}

}  // namespace talus::search
