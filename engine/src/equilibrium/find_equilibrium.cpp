// Pseudo-transient continuation: backward Euler on C du/dt = F(u) with a drag C, each step solved by Newton's method
// with the law's exact, unsymmetric derivative, the step growing as the motion slows down.

#include "equilibrium/find_equilibrium.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "contacts/update.h"
#include "equilibrium/balance.h"
#include "equilibrium/first_order_gaps.h"
#include "equilibrium/linear_solver.h"
#include "forces/sum.h"
#include "measure/measure.h"
#include "state/block_motion.h"
#include "state/caller.h"
#include "state/incidence.h"
#include "step/step.h"

namespace talus::equilibrium {
namespace {

// Steps in pseudo-time are counted in relaxation times of a block on its own joints.
constexpr double kFirstStep = 1e3;
constexpr double kFirstStepFromRest = 1e5;  // where only gaps of first order are to be brought to rest
constexpr double kRestStep = 1e3;           // rest is said of steps at least as long
constexpr double kLongestStep = 1e9;
constexpr double kShortestStep = 1e-2;
constexpr double kStepMotion =
    2e-3;  // most a block may go in a step, of its size: contacts are looked for in between
// ... but no block counts for smaller than this, of the median: one pebble would make the steps of all.
constexpr double kLeastSize = 0.25;
constexpr double kLookMotion = 1e-5;  // and the way after which they are
// Vertices and edges are looked at after a share of the way that blocks go between two looks in time (2e-4 of their size): as far
// apart an equilibrium may be that counts as near, so what holds has to be found sooner.
constexpr double kFiner = 4.0;
constexpr double kStepAccuracy = 0.02;   // residual of a step over the out-of-balance force before it
constexpr double kLimitAccuracy = 0.02;  // or over the limit at rest
constexpr double kMostOfLimit = 0.5;
constexpr std::int64_t kMostSteps = 4;  // for each factorisation: some steps need none
constexpr int kMostIterations = 15, kMostIterationsOfMany = 30;
// Where Newton's method fails to come nearer it is nearly always for a few blocks that slip, lift off and close again (five have
// 98 % of the residual in three of four such iterations). Either they have more drag, and with it shorter steps of their own, so that all
// others can go on with long ones: drag has no part in an equilibrium. Or the step ends there, as it is for them, and they go on by
// themselves, with what they touch, to where they come to rest (Options::leaves_few). Neither of few blocks: there shorter steps for all
// cost little, and friction remembers who slid first (Barla's table of leaning columns: 8.76 to 8.92 degrees for 8.85).
constexpr int kStalled = 4;              // iterations in which the residual is not halved
constexpr double kShortShare = 1.0 / 8;  // of a Newton step that could be gone
constexpr double kMoreDrag = 16.0, kMostDrag = 1e6, kLessDrag = 0.5;  // the last after each step
constexpr std::size_t kMostSlowed = 64;
constexpr double kOfOthers = 0.2;     // of the square of the residual: more, and it is not a few blocks
constexpr int kRings = 2;             // of blocks around the few, that move with them
constexpr double kMostOfPart = 0.25;  // of all blocks
constexpr std::int64_t kFactorsOfPart = 300;
constexpr int kFewIterations = 6, kSomeIterations = 12;  // the step grows much, or a little
// A step that Newton's method does not come to the end of costs most of all: the next ones stay below it, and are let
// grow beyond it only after some have gone well.
constexpr double kAfterFailure = 0.4;
constexpr int kStepsBelow = 5;
constexpr int kHalvings = 6;
constexpr double kLeastDecrease = 0.1;
constexpr double kRoundings[] = {1e-3, 1e-5, 1e-7, 0.0};  // of the median weight, one after the other
constexpr double kElasticParting = 20.0;                  // of the deepest joint's closure
constexpr double kSteady = 0.98;                          // speed over the fastest since a quarter of the way
constexpr double kGone = 0.01;                            // of the median block size

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Poses that are sought in a step, and the way there from its start.
struct Trial {
    Poses poses;
    Vec6s way;  ///< in the unknowns
};

/// What the solve of an assembly and those of its parts share.
struct Course {
    std::optional<FirstOrderGaps> first_order{};
    Poses start{};
    double deepest = 0;          ///< of the joints at the start [m]
    double reach = 0;            ///< of bolts, at the start [m]
    double median_weight = 0;    ///< [N]
    std::vector<double> gone{};  ///< by each block since contacts were looked for, kFiner times [m]
    double way_since_look = 0;   ///< farthest of any, over its size
};

class Solver {
 public:
    /// \param moving  by block: of a part of the assembly, the blocks that move; empty: all, and the course begins here
    Solver(State& state, const Options& options, Course& course, std::vector<char> moving)
        : state_(state), options_(options), course_(course), moving_(std::move(moving)) {
        slowed_.assign(state_.blocks.size(), 1.0);
        if (isPart()) {
            takeContacts();
            return;
        }
        if (options.stood != nullptr) course_.first_order.emplace(*options.stood, state);
        if (course_.first_order) course_.first_order->set(state_);
        updateBlockForces(state_);
        takeContacts();
        course_.gone.resize(state_.blocks.size());
        course_.start = at_.poses;
        course_.deepest = deepestPoint(state_, balance_);
        course_.reach = tieReach(state_);
        course_.median_weight = median(balance_.weight);
    }

    Equilibrium run() {
        const double release = state_.release;
        state_.release = options_.release;
        double ratio = residual(at_, 1.0, 0.0, false);
        for (double h = course_.first_order ? kFirstStepFromRest : kFirstStep;
             !finished() && h >= kShortestStep;) {
            ++result_.steps;
            // Below the limit at rest whatever rounding leaves, or a step that moves nothing would end well for ever.
            const double rounding = std::min(roundingLevel(), kMostOfLimit * options_.limit);
            const double tolerance =
                std::max({kLimitAccuracy * options_.limit, kStepAccuracy * ratio, rounding});
            if (!step(h, tolerance)) {
                too_long_ = h;
                steps_below_ = kStepsBelow;
                h *= kAfterFailure;
                continue;
            }
            for (double& slowed : slowed_) slowed = std::max(1.0, kLessDrag * slowed);
            commit();
            judge(h);
            if (result_.verdict == Verdict::undecided) lookForContacts();
            if (result_.verdict == Verdict::undecided && settleFew() && isBalanced()) settle(h);
            ratio = result_.out_of_balance;
            h = nextStep(h);
            --steps_below_;
        }
        state_.release = release;
        return result_;
    }

 private:
    bool isPart() const { return !moving_.empty(); }

    bool finished() const {
        return result_.verdict != Verdict::undecided || result_.factors >= options_.most_factors ||
               result_.steps >= kMostSteps * options_.most_factors || isStopped(options_.stop);
    }

    void takeContacts() {
        Balance next = makeBalance(state_, moving_);
        if (!linear_ || next.matrix.edges != balance_.matrix.edges)
            linear_.emplace(next.matrix, state_.instructions, options_.stop);
        balance_ = std::move(next);
        at_ = {posesOf(state_), Vec6s(balance_.block.size(), Vec6::Zero())};
    }

    /// What rounding of the coordinates leaves of the out-of-balance force: eps |x| k A / (m g).
    double roundingLevel() const {
        double level = 0;
        for (std::size_t r = 0; r < balance_.block.size(); ++r) {
            const double reach = coordinateReach(state_, at_.poses.position, balance_.block[r]);
            level = std::max(level, std::numeric_limits<double>::epsilon() * reach * balance_.drag[r] /
                                        balance_.weight[r]);
        }
        return level;
    }

    /// Of a row in a step, over the way [N/m].
    double drag(std::size_t r, double h) const { return slowed_[balance_.block[r]] * balance_.drag[r] / h; }

    /// Out-of-balance force less the drag of a step, into residual_. \return the largest over the weight
    double residual(const Trial& trial, double h, double rounding, bool stiffness) {
        sumForces(state_, balance_, trial.poses, rounding, stiffness, residual_);
        for (std::size_t r = 0; r < residual_.size(); ++r) residual_[r] -= drag(r, h) * trial.way[r];
        return largestRatio(balance_, residual_);
    }

    /// Square of a row's part in what Newton's steps shall lessen.
    double partOf(const Vec6s& residual, std::size_t r) const {
        return residual[r].squaredNorm() / (balance_.weight[r] * balance_.weight[r]);
    }

    /// What Newton's steps shall lessen.
    double merit() const {
        double sum = 0;
        for (std::size_t r = 0; r < residual_.size(); ++r) sum += partOf(residual_, r);
        return std::sqrt(sum);
    }

    /// The few blocks that have nearly all of a residual; empty where there are none.
    std::vector<std::size_t> fewOf(const Vec6s& residual) const {
        std::vector<std::pair<double, std::size_t>> parts;
        double left = 0;
        for (std::size_t r = 0; r < residual.size(); ++r) {
            parts.emplace_back(partOf(residual, r), r);
            left += parts.back().first;
        }
        if (!std::isfinite(left)) return {};
        const std::size_t most = std::min(kMostSlowed, std::max<std::size_t>(1, parts.size() / 4));
        std::partial_sort(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(most), parts.end(),
                          std::greater<>());
        const double of_others = kOfOthers * left;
        std::size_t few = 0;
        while (few < most && left > of_others) left -= parts[few++].first;
        if (left > of_others) return {};
        std::vector<std::size_t> blocks;
        for (std::size_t k = 0; k < few; ++k) blocks.push_back(balance_.block[parts[k].second]);
        return blocks;
    }

    /// Gives the few more drag. \return whether there are such
    bool slowFew(const Vec6s& residual) {
        const std::vector<std::size_t> few = fewOf(residual);
        for (const std::size_t b : few) slowed_[b] = std::min(kMoreDrag * slowed_[b], kMostDrag);
        return !few.empty();
    }

    /// Whether the few go on by themselves after each step, which need not have come to its end for them.
    bool leavesFew() const {
        return options_.leaves_few && !isPart() && balance_.block.size() >= kBlocksWithCrumbs;
    }

    void moveBy(double share, Trial& trial) const {
        move(balance_, direction_, share, trial.poses);
        for (std::size_t r = 0; r < trial.way.size(); ++r) trial.way[r] += share * direction_[r];
    }

    /// The longest of a few halved Newton steps that lessens the residual enough, else the best of them.
    /// \param before  the merit at the trial
    /// \return its share of the step, 0 where none gives a number; of_whole_ is the residual after the whole step
    double searchLine(double h, double rounding, double before, Trial& trial) {
        double best = kInfinity;
        double share = 1, best_share = 0;
        for (int k = 0; k < kHalvings; ++k, share *= 0.5) {
            tried_ = trial;
            moveBy(share, tried_);
            residual(tried_, h, rounding, false);
            if (k == 0) of_whole_ = residual_;
            const double now = merit();
            if (now < best) best = now, best_share = share;
            if (now < before * (1.0 - kLeastDecrease * share)) break;
        }
        if (best_share > 0) moveBy(best_share, trial);
        return best_share;
    }

    /// \return whether it came to the end of the step, or where few may be left behind did for all others
    bool newton(double h, double tolerance, double rounding, Trial& trial) {
        const bool are_many = residual_.size() >= kBlocksWithCrumbs;
        const int most = are_many ? kMostIterationsOfMany : kMostIterations;
        double least = kInfinity;
        int stalled = 0;
        for (int k = 0; k < most; ++k) {
            if (residual(trial, h, rounding, true) < tolerance) return true;
            double now = merit();
            stalled = now < 0.5 * least ? 0 : stalled + 1;
            if (stalled == 0) least = now;
            if (are_many && stalled == kStalled) {
                if (leavesFew()) {
                    lagging_ = fewOf(residual_);
                    return !lagging_.empty();
                }
                if (!slowFew(residual_)) return false;
                residual(trial, h, rounding, true);
                least = now = merit();
                stalled = 0;
            }
            for (std::size_t r = 0; r < residual_.size(); ++r)
                balance_.matrix.diagonal[r].diagonal().array() += drag(r, h);
            ++iterations_;
            ++result_.factors;
            direction_ = residual_;
            if (!linear_->solve(balance_.matrix, balance_.weight, direction_)) return false;
            const double share = searchLine(h, rounding, now, trial);
            if (share == 0) return false;
            if (are_many && !leavesFew() && share <= kShortShare && slowFew(of_whole_)) least = kInfinity;
        }
        return residual(trial, h, rounding, false) < tolerance;
    }

    /// With the corner of the normal law rounded less and less: Newton's method otherwise may go round in circles
    /// between contacts that open and close.
    bool newtonByRounding(double h, double tolerance, Trial& trial) {
        bool converged = false;
        for (const double rounding : kRoundings) {
            converged = newton(h, tolerance, rounding * course_.median_weight, trial);
            if (!converged && rounding == kRoundings[0]) return false;
        }
        return converged;
    }

    /// The few blocks that are not at rest; where many are not, those of them that were left behind in the last step.
    std::vector<std::size_t> fewRestless() const {
        const Vec3 acceleration = bodyAcceleration(state_);
        const auto is_at_rest = [&](std::size_t b) {
            return outOfBalanceRatio(state_, b, acceleration) < options_.limit;
        };
        std::vector<std::size_t> restless = balance_.block;
        std::erase_if(restless, is_at_rest);
        if (restless.size() <= kMostSlowed) return restless;
        restless = lagging_;
        std::erase_if(restless, is_at_rest);
        return restless;
    }

    /// Lets the few blocks that lag behind go on by themselves while all others stay; where they leave their place, so does the
    /// assembly. \return whether they have come to rest
    bool settleFew() {
        if (!leavesFew()) return false;
        const std::vector<std::size_t> few = fewRestless();
        if (few.empty()) return false;
        std::vector<char> part(state_.blocks.size(), 0);
        for (const std::size_t b : few) part[b] = 1;
        part = withNeighbours(state_, std::move(part), kRings, Through::all_blocks);
        const double share = static_cast<double>(std::count(part.begin(), part.end(), 1)) /
                             static_cast<double>(balance_.block.size());
        if (share > kMostOfPart) return false;
        Options options = options_;
        options.most_factors = kFactorsOfPart;
        const Equilibrium found = Solver(state_, options, course_, std::move(part)).run();
        count(found, share);
        takeContacts();
        result_.out_of_balance = outOfBalance();
        return found.verdict == Verdict::stable;
    }

    /// Takes over what was found of a part with this share of the blocks.
    void count(const Equilibrium& part, double share) {
        work_of_parts_ += share * static_cast<double>(part.factors);
        const double whole = std::floor(work_of_parts_);
        work_of_parts_ -= whole;
        result_.factors += static_cast<std::int64_t>(whole);
        if (part.verdict != Verdict::failing) return;
        result_.verdict = Verdict::failing;
        result_.parted = std::max(result_.parted, part.parted);
        result_.displacement = std::max(result_.displacement, part.displacement);
    }

    /// One step of backward Euler. False, and nothing has moved, when it is too long.
    bool step(double h, double tolerance) {
        iterations_ = 0;
        motion_ = 0;
        lagging_.clear();
        Trial trial = at_;
        if (!newton(h, tolerance, 0.0, trial)) {
            trial = at_;
            if (!newtonByRounding(h, tolerance, trial)) return false;
        }
        const auto way_of = [&](std::size_t r) {
            return trial.way[r].head<3>().norm() + trial.way[r].tail<3>().norm();
        };
        const double least_size = kLeastSize * state_.geometry->length_scale;
        for (std::size_t r = 0; r < trial.way.size(); ++r)
            motion_ = std::max(motion_, way_of(r) / std::max(balance_.size[r], least_size));
        if (motion_ > kStepMotion) return false;
        for (std::size_t r = 0; r < trial.way.size(); ++r)
            course_.gone[balance_.block[r]] += kFiner * way_of(r);
        at_.poses = std::move(trial.poses);
        return true;
    }

    /// Makes the poses those of the state: plastic slides by its own kernel, bonds let down, water where it is now.
    void commit() {
        setPoses(at_.poses, state_);
        if (course_.first_order) course_.first_order->set(state_);
        updateForces(state_, options_.parallel);
        result_.out_of_balance = outOfBalance();
    }

    /// As outOfBalanceRatio of the state, but of the blocks that move here.
    double outOfBalance() const {
        const Vec3 acceleration = bodyAcceleration(state_);
        double largest = 0;
        for (const std::size_t b : balance_.block)
            largest = std::max(largest, outOfBalanceRatio(state_, b, acceleration));
        return largest;
    }

    /// Whether bonds are being let down, call by call. One that softens is always as weak as its place makes it.
    bool bondsGive() const {
        if (!state_.points.remembers()) return false;
        for (const ActiveInterface& i : balance_.interfaces) {
            const auto joint = static_cast<std::size_t>(state_.interfaces.joint[i.interface]);
            if (contact::softens(state_.laws[joint])) continue;
            for (std::size_t k = 0; k < state_.interfaces.pointCount(i.interface); ++k) {
                const double bond = state_.points.memoryAt(state_.interfaces.pointSlot(i.interface, k)).bond;
                if (bond > 0 && bond < 1) return true;
            }
        }
        return false;
    }

    void judge(double h) {
        result_.displacement = result_.parted = 0;
        for (std::size_t r = 0; r < balance_.block.size(); ++r) {
            const std::size_t b = balance_.block[r];
            const double way =
                (at_.poses.position.get(b) - course_.start.position.get(b)).norm() +
                rotationFrom(course_.start.orientation, at_.poses.orientation, b) * balance_.radius[r];
            result_.displacement = std::max(result_.displacement, way);
        }
        for (const ActiveInterface& i : balance_.interfaces)
            result_.parted = std::max(result_.parted, relativeMotion(state_, i, course_.start, at_.poses));
        const double size = state_.geometry->length_scale;
        const double leaves =
            std::max(options_.leaves * size, kElasticParting * course_.deepest) + course_.reach;
        result_.leaving = result_.parted / leaves;
        if (isBalanced()) return settle(h);
        if (result_.parted > kGone * size + course_.reach ||
            (!isPart() && result_.parted > leaves && goesOnAsFast(motion_ / h)))
            result_.verdict = Verdict::failing;
        track_.push_back({result_.parted, motion_ / h});
    }

    bool isBalanced() const { return result_.out_of_balance < options_.limit; }

    /// Balanced, it is at rest if the last step was a long one for all.
    void settle(double h) {
        const double slowest = *std::max_element(slowed_.begin(), slowed_.end());
        if (h >= kRestStep * slowest && !bondsGive()) result_.verdict = Verdict::stable;
    }

    /// Whether it is about as fast as it was at any time since a quarter of the way. A spring that stops it would
    /// slow it down; so does a large load step an elastic assembly, if only at the end of its way.
    bool goesOnAsFast(double speed) const {
        double fastest = 0;
        for (const auto& [way, speed_there] : track_)
            if (way >= 0.25 * result_.parted) fastest = std::max(fastest, speed_there);
        return fastest > 0 && speed > kSteady * fastest;
    }

    void lookForContacts() {
        course_.way_since_look += motion_;
        if (course_.way_since_look > kLookMotion && !course_.first_order) {
            course_.way_since_look = 0;
            refreshInterfaces(state_, options_.parallel, 0.0, options_.stop, course_.gone);
            course_.gone.assign(course_.gone.size(), 0.0);
            takeContacts();
        } else {
            readApplied(state_, balance_);
        }
    }

    double nextStep(double h) const {
        double growth = 1.0;
        if (iterations_ <= kFewIterations)
            growth = 4.0;
        else if (iterations_ <= kSomeIterations)
            growth = 2.0;
        else if (iterations_ > kMostIterations)
            growth = 0.5;
        if (motion_ > 0) growth = std::min(growth, 0.8 * kStepMotion / motion_);
        const double longest = steps_below_ > 0 ? kAfterFailure * too_long_ : kLongestStep;
        return std::min(growth * h, longest);
    }

    State& state_;
    const Options& options_;
    Balance balance_{};
    Trial at_{};  ///< where the state is, its way zero
    Course& course_;
    std::vector<char> moving_;  ///< by block; empty: all that are free
    double work_of_parts_ = 0;  ///< in factorisations of all blocks, not counted yet
    std::optional<LinearSolver> linear_{};
    Equilibrium result_{};
    std::vector<std::pair<double, double>> track_{};  ///< after each step: way, speed
    double too_long_ = kLongestStep;                  ///< the last step that failed
    int steps_below_ = 0;                             ///< still to be made shorter than that
    int iterations_ = 0;                              ///< of the last step
    double motion_ = 0;                               ///< of it, over the block's size
    std::vector<double> slowed_{};                    ///< times its own that each block's drag is
    std::vector<std::size_t> lagging_{};  ///< blocks for which the last step did not come to its end
    Vec6s residual_{}, of_whole_{}, direction_{};
    Trial tried_{};
};

}  // namespace

Equilibrium findEquilibrium(State& state, const Options& options) {
    Course course;
    return Solver(state, options, course, {}).run();
}

}  // namespace talus::equilibrium
