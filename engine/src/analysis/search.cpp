// Critical angle, factor of safety and critical acceleration: one search over a load that only grows, each probe from the last stable state.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "analysis/bracket.h"
#include "analysis/failure_mode.h"
#include "analysis/initial_state.h"
#include "analysis/loose_blocks.h"
#include "analysis/quasi_static.h"
#include "analysis/threads.h"
#include "build/build.h"
#include "frame/frame.h"
#include "law/joint_laws.h"
#include "measure/measure.h"
#include "talus/analysis.h"

namespace talus {
namespace {

constexpr double kOverload = 8.0;  // cells beyond the failing load at which the continuation runs
constexpr int kAttempts = 3;  // with half the time step and longer windows, when a failure is not confirmed
constexpr int kAttemptsAtStart = 2;
constexpr int kMostReopenings = 12;  // times a failing motion may come to rest before the search gives up
constexpr std::int64_t kFirstSteps = 20'000;  // of a probe, before the implicit solve is asked
// Factorisations that one may take: about as long as the steps so far, at least a number that decides most.
constexpr std::int64_t kLeastFactors = 30, kMostFactors = 600, kStepsPerFactor = 2000;
// Rest is near when it is no farther than this times the way the assembly has come, from rest to rest.
constexpr double kNear = 1.0;
constexpr double kMorePatience = 3.0;
constexpr double kSettlingDrag = 0.125;
constexpr double kSettlingPeriods = 3.0;
constexpr double kStartPeriods = 20.0;  // nothing is known of the slowest period yet but a guess
// A failure is a failure when blocks have been seen to go this share of their size and gather speed. Near the critical
// load that takes long; at the start, where no deflection at rest is known to compare with, more is asked for.
constexpr double kSeenShare = 2e-4, kSeenAtStart = 0.01;
// Steps of the continuation: as many as the probes took, but a number that shows something, and not without bound.
constexpr std::int64_t kLeastSteps = 40'000, kMostSteps = 400'000, kMostStepsAtStart = 100'000;

/// The load that is searched over. Probes stand on a grid of cells no wider than the tolerance, so that the bracket
/// found is one of these cells whatever way led to it.
struct Axis {
    double start = 0;
    bool tenfold_at_start = false;   ///< at the start joints have ten times their strength
    std::int64_t stop = 0;           ///< [cells from the start]
    double cell = 0;                 ///< width of the bracket
    double imbalance_tolerance = 0;  ///< out-of-balance force over weight that a change by one cell is worth
    std::function<std::int64_t(std::int64_t)> next;  ///< from a stable load to the next one up [cells]
    std::function<void(State&, double)> apply;
    std::function<std::string(double)> say;  ///< for progress

    double load(std::int64_t cells) const { return start + cell * static_cast<double>(cells); }
};

std::string formatted(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

double degrees(double radians) { return radians * 180.0 / M_PI; }

class Search {
 public:
    Search(const State& state, const Axis& axis, const Control& control, const QuasiStatic& settings,
           bool parallel)
        : axis_(axis),
          control_(control),
          parallel_(parallel),
          bracket_(axis.stop),
          last_stable_(state),
          work_(analysis::prepare(last_stable_, settings, control, axis.imbalance_tolerance, parallel)) {}

    SearchResult run() {
        if (start())
            for (int k = 0; k <= kMostReopenings && searchUpwards(); ++k) {
            }
        finish();
        return std::move(result_);
    }

    /// Gravity and water; what fails goes on until it is seen to. True when the assembly stands.
    bool start() {
        result_.low = -kInfinity;
        result_.high = kInfinity;
        if (loadGravityAndWater()) return true;
        if (result_.status != SearchStatus::unstable_at_start || interrupted()) return false;
        continueToFailure();
        if (result_.confirmed || interrupted() || !restsAfterAll()) return false;
        result_.status = SearchStatus::undecided;
        result_.high = kInfinity;
        result_.low = axis_.start;
        return true;
    }

    std::int64_t steps() const { return probe_steps_ + continuation_steps_; }

    /// Blocks that were seen to fall in the continuation.
    const std::vector<std::size_t>& falling() const { return falling_; }

 private:
    bool interrupted() const {
        return control_.stop != nullptr && control_.stop->load(std::memory_order_relaxed);
    }

    void report(const std::string& stage, double load, Verdict verdict) const {
        if (!control_.progress) return;
        // Longer than most, and never down to nothing: what comes after the last probe takes as long as some of them.
        constexpr double kAfterwards = 4.0;
        const double probes = static_cast<double>(result_.probes.size());
        const double expected = std::max(6.0 + std::log2(static_cast<double>(axis_.stop)) / 2, probes + 1);
        control_.progress(
            {stage, probes / (expected + kAfterwards), axis_.say(load) + ", " + toString(verdict)});
    }

    /// One probe from the last stable state; keeps the state it ends in. Explicit steps first, which are quick where
    /// blocks slide; what they leave open, and what seems to fail before the assembly has stood, the implicit solve
    /// answers. A model that once needed it is asked that way first. Where neither knows, explicit steps go on.
    Verdict probe(const std::string& stage, double load, const analysis::Ramp& ramp) {
        if (implicit_first_)
            if (const Verdict found = probeImplicitly(stage, load, ramp); found != Verdict::undecided)
                return found;
        analysis::QuasiStaticWork work = work_;
        work.settings.max_steps_per_probe = std::min(kFirstSteps, work_.settings.max_steps_per_probe);
        const State before = last_stable_;
        Verdict verdict = probe(stage, load, before, work, ramp);
        keepLearnt(work);
        const bool doubtful = verdict == Verdict::failing && result_.low == -kInfinity;
        if (verdict == Verdict::stable || (verdict == Verdict::failing && !doubtful) || interrupted())
            return verdict;
        if (!implicit_first_) {
            const State moving = last_moving_;
            const Verdict found = probeImplicitly(stage, load, ramp);
            if (found != Verdict::undecided) implicit_first_ = true;
            if (found != Verdict::stable) last_moving_ = moving;  // nearer to rest, where a failure is let go
            if (found != Verdict::undecided) return found;
        }
        if (verdict == Verdict::failing) return verdict;
        work = work_;
        verdict = probe(stage, load, last_moving_, work, [](State&, double) {});
        keepLearnt(work);
        return verdict;
    }

    void keepLearnt(const analysis::QuasiStaticWork& work) {
        const QuasiStatic settings = work_.settings;
        work_ = work;
        work_.settings = settings;
    }

    /// How far the assembly has come in all, from rest to rest [m].
    double deflection() const {
        double sum = 0;
        for (const Probe& p : result_.probes)
            if (p.verdict == Verdict::stable) sum += p.displacement;
        return sum;
    }

    /// Whether an equilibrium is where the assembly stands, but for what it gives. Blocks that lean on each other have others,
    /// farther off, in which they are jammed: to get there is to fail first.
    bool isNear(const Probe& probe) const {
        return result_.low == -kInfinity || probe.displacement <= nearLimit();
    }

    double nearLimit() const {
        return std::max(kSeenShare * last_stable_.geometry->length_scale, kNear * deflection());
    }

    /// Of the farthest-moved block [m].
    static double wayBetween(const State& from, const State& to) {
        double farthest = 0;
        for (std::size_t b = 0; b < from.blocks.size(); ++b)
            farthest = std::max(farthest, (to.blocks.position.get(b) - from.blocks.position.get(b)).norm());
        return farthest;
    }

    /// From the last stable state, the whole change of load at once.
    Verdict probeImplicitly(const std::string& stage, double load, const analysis::Ramp& ramp,
                            bool patiently = false) {
        const bool doubtful = patiently || implicit_first_ || result_.low == -kInfinity;
        const std::int64_t most_factors =
            doubtful ? kMostFactors : std::clamp(probe_steps_ / kStepsPerFactor, kLeastFactors, kMostFactors);
        State state = last_stable_;
        ramp(state, 1.0);
        Probe found = analysis::findRest(state, work_, most_factors);
        if (found.verdict == Verdict::stable && !isNear(found)) {
            found.verdict = Verdict::failing;
            stands_elsewhere_ = true;
            found.reason = "moves " + formatted("%.2g", found.displacement) + " m to where it stands again";
            state = last_stable_;
            ramp(state, 1.0);
        }
        return keep(stage, load, found, state);
    }

    Verdict probe(const std::string& stage, double load, State state, analysis::QuasiStaticWork& work,
                  const analysis::Ramp& ramp) {
        return keep(stage, load, analysis::bringOn(state, work, ramp), state);
    }

    Verdict keep(const std::string& stage, double load, Probe probe, State& state) {
        probe.load = load;
        probe_steps_ += probe.steps;
        result_.factors += probe.factors;
        result_.probes.push_back(probe);
        report(stage, load, probe.verdict);
        (probe.verdict == Verdict::stable ? last_stable_ : last_moving_) = std::move(state);
        return probe.verdict;
    }

    Verdict probeAt(std::int64_t cell) {
        const double from = axis_.load(bracket_.low()), to = axis_.load(cell);
        const auto ramp = [&](State& state, double share) { axis_.apply(state, from + share * (to - from)); };
        const Verdict verdict = probe("probe " + std::to_string(result_.probes.size() + 1), to, ramp);
        if (verdict == Verdict::stable) bracket_.stands(cell);
        if (verdict == Verdict::failing) bracket_.fails(cell, result_.probes.back().out_of_balance);
        return verdict;
    }

    /// Weight at the start's tilt. What fails is watched on patiently, as other failures are, and then tried once
    /// more from the beginning, slowly.
    Verdict loadGravity() {
        const State unloaded = last_stable_;
        Verdict verdict = probe("gravity", axis_.start,
                                [](State& state, double share) { state.load.gravity_share = share; });
        if (verdict == Verdict::failing && settles(last_moving_, axis_.start, kStartPeriods)) {
            analysis::learnPeriod(work_, unloaded, last_stable_);
            verdict = Verdict::stable;
        }
        if (verdict == Verdict::stable || interrupted()) return verdict;
        last_stable_ = unloaded;
        return loadGravityInParts();
    }

    /// Weight in parts on level ground, then the tilt in parts: from each the slowest period is learnt. Laid on at
    /// once, close below the angle at which a column topples, weight sets off a rocking so slow that it looks like
    /// failure.
    Verdict loadGravityInParts() {
        constexpr std::array<double, 5> kParts{0.125, 0.25, 0.5, 0.75, 1.0};
        const double tilt = last_stable_.load.tilt;
        last_stable_.load.tilt = 0;
        const Verdict level = bringOnInParts(
            "gravity in parts", kParts, [](State& state, double share) { state.load.gravity_share = share; });
        if (level != Verdict::stable || tilt == 0) return level;
        return bringOnInParts("tilting", kParts,
                              [tilt](State& state, double share) { state.load.tilt = share * tilt; });
    }

    /// Ends with the first part that does not come to rest, however patiently it is watched.
    Verdict bringOnInParts(const std::string& stage, std::span<const double> parts,
                           const analysis::Ramp& load) {
        Verdict verdict = Verdict::stable;
        double from = 0;
        for (const double to : parts) {
            if (verdict != Verdict::stable || interrupted()) break;
            const State before = last_stable_;
            verdict = probe(stage, axis_.start,
                            [&](State& state, double share) { load(state, from + share * (to - from)); });
            if (verdict == Verdict::failing && settles(last_moving_, axis_.start, kStartPeriods)) {
                analysis::learnPeriod(work_, before, last_stable_);
                verdict = Verdict::stable;
            }
            from = to;
        }
        return verdict;
    }

    Verdict loadWater() {
        const Verdict verdict =
            probe("water", axis_.start, [](State& state, double share) { state.load.water_share = share; });
        const bool rests = verdict == Verdict::failing && settles(last_moving_, axis_.start, kStartPeriods);
        return rests ? Verdict::stable : verdict;
    }

    /// Whether what went on under its full weight and was not borne out comes to rest where it has got to.
    bool restsAfterAll() {
        State moved = last_moving_;
        axis_.apply(moved, axis_.start);
        if (moved.load.gravity_share < 1 || moved.load.tilt != start_tilt_) return false;
        analysis::takeBack(moved, work_);
        if (!settles(moved, axis_.start, kStartPeriods)) return false;
        const bool dry = last_stable_.geometry->model.waters.empty() || last_stable_.load.water_share == 1;
        return dry || loadWater() == Verdict::stable;
    }

    /// Gravity at the start, then water. True when the assembly stands.
    bool loadGravityAndWater() {
        axis_.apply(last_stable_, axis_.start);
        start_tilt_ = last_stable_.load.tilt;
        last_stable_.load.gravity_share = last_stable_.load.water_share = 0;
        Verdict verdict = loadGravity();
        if (verdict == Verdict::stable && !last_stable_.geometry->model.waters.empty()) verdict = loadWater();
        if (verdict == Verdict::failing) {
            result_.status = SearchStatus::unstable_at_start;
            result_.high = axis_.start;
        }
        if (verdict == Verdict::stable) result_.low = axis_.start;
        settlement_ = deflection();
        return verdict == Verdict::stable;
    }

    /// Finds a failing cell and lets it go on. True when the motion came to rest there: the assembly has moved to where
    /// it stands again (columns that lean on each other do), and the search is to go on from that state.
    bool searchUpwards() {
        result_.status = SearchStatus::undecided;
        findFailure();
        narrow();
        if (result_.status != SearchStatus::found) return false;
        if (hasFailed(axis_.load(*bracket_.high()))) return false;
        result_.confirmed = false;
        bracket_.reopen();
        return true;
    }

    /// Whether the failing load is one, and not a load at which the assembly comes to stand again. Watched for longer, and
    /// let go, a slide is sharp; no other failure counts before the implicit solve has failed to find rest.
    bool hasFailed(double load) {
        stands_elsewhere_ = no_rest_ = false;
        if (!implicit_first_) {
            State moving = last_moving_;
            continueToFailure();
            if (interrupted()) return true;
            std::swap(last_moving_, moving);
            if (result_.confirmed && result_.mode == FailureMode::sliding) {
                if (settles(State(last_moving_), load)) return false;
                std::swap(last_moving_, moving);
                return true;
            }
            const Verdict found = restAt(load);
            if (found == Verdict::stable) return false;
            if (found == Verdict::undecided && settles(State(last_moving_), load)) return false;
            result_.confirmed = result_.confirmed || stands_elsewhere_;
            if (result_.confirmed || !no_rest_) std::swap(last_moving_, moving);
            if (result_.confirmed) return true;
        } else {
            const Verdict found = restAt(load);
            if (found == Verdict::stable) return false;
            if (found == Verdict::undecided && settles(State(last_moving_), load)) return false;
        }
        if (implicit_first_ || no_rest_) continueToFailure();
        // What stands again only where it is jammed has failed, whether or not the motion is seen to get there.
        result_.confirmed = result_.confirmed || stands_elsewhere_;
        if (result_.confirmed || interrupted()) return true;
        State moved = last_moving_;
        axis_.apply(moved, load);
        analysis::takeBack(moved, work_);
        return !settles(moved, load);
    }

    /// What the implicit solve finds at the failing load, given its time: blocks that topple may have been shaken there
    /// by the explicit steps.
    Verdict restAt(double load) {
        State moving = last_moving_;
        const Verdict found = probeImplicitly(
            "equilibrium", load, [&](State& state, double) { axis_.apply(state, load); }, true);
        no_rest_ = found == Verdict::failing && !stands_elsewhere_;
        if (found == Verdict::stable)
            implicit_first_ = true;
        else
            last_moving_ = std::move(moving);  // nearer to rest, where a failure is let go
        return found;
    }

    /// Whether a state that moves at a load comes to rest when it is watched for longer; it is the last stable one
    /// then. A mode many times slower than the slowest known one looks like failure for a while: close below the load
    /// at which a column topples its stiffness goes to zero.
    bool settles(const State& moving, double load, double watch_periods = kSettlingPeriods) {
        analysis::QuasiStaticWork patient = analysis::patient(work_, kSettlingDrag, watch_periods);
        const auto hold = [](State&, double) {};
        const State before = last_stable_;
        if (probe("settling", load, moving, patient, hold) != Verdict::stable) return false;
        if (result_.low == -kInfinity || wayBetween(before, last_stable_) <= nearLimit()) return true;
        stands_elsewhere_ = true;
        last_moving_ = std::exchange(last_stable_, before);
        return false;
    }

    /// Up from the start until a probe fails or the end is reached.
    void findFailure() {
        while (!bracket_.high() && !bracket_.stoodToTheEnd() && !interrupted())
            if (probeAt(bracket_.up(axis_.next(bracket_.low()))) == Verdict::undecided) return;
        if (bracket_.stoodToTheEnd()) result_.status = SearchStatus::stable_to_stop;
    }

    /// An undecided probe is answered by one between it and the failing load; a second one ends the search.
    void narrow() {
        while (bracket_.high() && !bracket_.closed() && !interrupted()) {
            const std::int64_t cell = bracket_.next();
            if (probeAt(cell) != Verdict::undecided) continue;
            const std::int64_t higher = (cell + *bracket_.high() + 1) / 2;
            if (higher >= *bracket_.high() || probeAt(higher) == Verdict::undecided) break;
        }
        if (bracket_.closed()) result_.status = SearchStatus::found;
    }

    void finish() {
        if (interrupted()) result_.status = SearchStatus::interrupted;
        if (result_.low > -kInfinity) result_.low = axis_.load(bracket_.low());
        if (bracket_.high()) result_.high = axis_.load(*bracket_.high());
        if (result_.status == SearchStatus::found) result_.answer = 0.5 * (result_.low + result_.high);
        const bool fails =
            result_.status == SearchStatus::found || result_.status == SearchStatus::unstable_at_start;
        const State& last = fails ? last_moving_ : last_stable_;
        if (!fails) result_.failing = nullptr;
        result_.steps = steps();
        result_.state_hash = stateHash(last);
        result_.inertia_scaled = work_.inertia_scaled;
        result_.damping_local = work_.settings.local_damping;
        result_.blocks = last.blocks.size();
        result_.interfaces = last.interfaces.size();
        result_.contact_points = last.points.size();
        result_.warnings = last.warnings;
        warnOfSoftJoints(last);
    }

    /// The formulas are for joints that do not give.
    void warnOfSoftJoints(const State& state) {
        constexpr double kSoft = 1e-4;  // of the block size
        if (deflection() <= kSoft * state.geometry->length_scale) return;
        result_.warnings.push_back(
            "the joints are soft against the stress on them: blocks move by " +
            formatted("%.2g", deflection()) +
            " m before they fail, so toppling blocks turn about points inside their edges, and "
            "formulas for rigid joints give higher values");
    }

    /// What is to be seen of a failure: at the start, a block that has gone a share of its size; else less of that, but
    /// several times what the assembly has moved at rest. What it has crept from rest to rest is not asked for again
    /// where no rest is found by either way.
    analysis::Evidence evidence() const {
        const std::int64_t most = std::clamp(probe_steps_, kLeastSteps, kMostSteps);
        if (!bracket_.high())
            return {.deflection = 0, .share = kSeenAtStart, .most_steps = kMostStepsAtStart};
        const double settled = std::max(kSeenShare * last_stable_.geometry->length_scale, settlement_);
        const double deflected = no_rest_ ? std::min(deflection(), settled) : deflection();
        return {.deflection = deflected, .share = kSeenShare, .most_steps = most};
    }

    void continueToFailure() {
        // A few cells beyond the failing load, because at it the motion would start as slowly as the bracket is fine.
        const double load = bracket_.high() ? axis_.load(*bracket_.high()) : axis_.start;
        axis_.apply(last_moving_, load + kOverload * axis_.cell);
        std::shared_ptr<FailingState> failing;
        if (control_.keep_failing_state)
            failing = std::make_shared<FailingState>(
                FailingState{fullFrameOf(last_moving_), load + kOverload * axis_.cell});
        analysis::Failure failure = analysis::continueFailure(last_moving_, evidence(), control_, parallel_);
        if (failing) {
            failing->contact_damping = last_moving_.damping.contact;
            failing->block_size = last_moving_.geometry->length_scale;
        }
        result_.failing = failure.confirmed ? std::move(failing) : nullptr;
        result_.mode = failure.mode;
        result_.moving_blocks = std::move(failure.moving_blocks);
        result_.motions = std::move(failure.motions);
        result_.continuation_seconds = failure.seconds;
        result_.time_step = failure.time_step;
        continuation_steps_ += failure.steps;
        result_.confirmed = failure.confirmed;
        falling_ = std::move(failure.falling);
        if (failure.confirmed && failure.at_rest)
            last_moving_.warnings.push_back("the failing motion came to rest after " +
                                            formatted("%.3g", failure.motion) +
                                            " m: the assembly moves at this load, but stands again");
    }

    const Axis& axis_;
    const Control& control_;
    bool parallel_;
    analysis::Bracket bracket_;
    State last_stable_;
    State last_moving_;
    analysis::QuasiStaticWork work_;
    SearchResult result_;
    double start_tilt_ = 0;  ///< [rad]
    double settlement_ = 0;  ///< under weight and water at the start [m]
    std::vector<std::size_t> falling_{};
    bool stands_elsewhere_ =
        false;              ///< the implicit solve found an equilibrium at the failing load, but not near
    bool no_rest_ = false;  ///< nor any other there
    bool implicit_first_ = false;  ///< explicit steps have not been enough
    std::int64_t probe_steps_ = 0, continuation_steps_ = 0;
};

bool claimsFailure(const SearchResult& result) {
    return result.status == SearchStatus::found || result.status == SearchStatus::unstable_at_start;
}

struct Outcome {
    SearchResult result;
    std::vector<std::size_t> falling;  ///< blocks of the state that were seen to fall
};

bool stopped(const Control& control) {
    return control.stop != nullptr && control.stop->load(std::memory_order_relaxed);
}

/// A failure that the continuation with true inertia does not bear out was one of the numbers (contacts that chatter
/// at too long a step, a mode far slower than its estimate): the search is made again with half the step and longer
/// windows, and is undecided if that does not help.
Outcome searchConfirmed(const State& state, const Axis& axis, const Control& control, QuasiStatic settings,
                        bool parallel) {
    std::int64_t steps = 0, factors = 0;
    for (int attempt = 1;; ++attempt) {
        Search search(state, axis, control, settings, parallel);
        SearchResult result = search.run();
        result.steps += steps;
        result.factors += factors;
        if (!claimsFailure(result) || result.confirmed) return {std::move(result), search.falling()};
        if (attempt == (result.status == SearchStatus::found ? kAttempts : kAttemptsAtStart)) {
            result.status = SearchStatus::undecided;
            result.warnings.push_back(
                "the failing motion is not borne out by the continuation with true inertia");
            return {std::move(result), {}};
        }
        if (stopped(control)) {
            result.status = SearchStatus::interrupted;
            return {std::move(result), {}};
        }
        steps = result.steps;
        factors = result.factors;
        settings.step_safety *= 0.5;
        settings.watch_periods *= kMorePatience;
    }
}

void warnOfFreeBlocks(State& state) {
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        if (state.blocks.motion[b] == Motion::free && !analysis::touchesSomething(state, b)) {
            state.warnings.push_back("block \"" + state.geometry->model.blocks[b].name +
                                     "\" touches no other block at the start");
            return;
        }
}

/// Searches, and searches again without the blocks that fall at the start whatever the strength.
class SearchOfTheRest {
 public:
    /// \param without blocks that are not to take part
    SearchOfTheRest(const Model& model, const Axis& axis, const Control& control, const QuasiStatic& settings,
                    const std::vector<std::string>& without)
        : model_(model),
          axis_(axis),
          control_(control),
          settings_(settings),
          gone_(analysis::blocksNamed(model, without)) {}

    Result<SearchResult> run() {
        std::int64_t steps = 0;
        for (;;) {
            Result<State> built = buildState(left(), control_.threads != 1);
            if (!built) return built.errors();
            const bool parallel = analysis::worthThreads(*built, control_.threads);
            warnOfFreeBlocks(*built);
            Outcome outcome = searchConfirmed(*built, axis_, control_, settings_, parallel);
            if (outcome.result.status == SearchStatus::unstable_at_start && !axis_.tenfold_at_start)
                outcome.falling = fallingAtTenfoldStrength(*built, parallel, steps);
            outcome.result.steps += steps;
            if (outcome.result.status != SearchStatus::unstable_at_start || !letGo(outcome.falling))
                return named(std::move(outcome.result));
            steps = outcome.result.steps;
        }
    }

 private:
    std::shared_ptr<const Model> left() const {
        const bool all = std::find(gone_.begin(), gone_.end(), 1) == gone_.end();
        return all ? keptByCaller(model_)
                   : std::make_shared<const Model>(analysis::withoutBlocks(model_, gone_));
    }

    std::vector<std::size_t> fallingAtTenfoldStrength(State strong, bool parallel,
                                                      std::int64_t& steps) const {
        strong.laws = jointLaws(model_.joints, analysis::kTenfoldStrength);
        Search search(strong, axis_, control_, settings_, parallel);
        search.start();
        steps += search.steps();
        return search.falling();
    }

    /// Takes out what falls, counted in blocks that are left. False when there is nothing, or too much for loose
    /// blocks.
    bool letGo(const std::vector<std::size_t>& falling) {
        if (falling.empty() || stopped(control_)) return false;
        std::vector<char> loose = loose_.empty() ? std::vector<char>(gone_.size(), 0) : loose_;
        std::size_t left = 0;
        auto next = falling.begin();
        for (std::size_t b = 0; b < gone_.size() && next != falling.end(); ++b) {
            if (gone_[b] || left++ != *next) continue;
            loose[b] = 1;
            ++next;
        }
        if (analysis::looseShare(model_, loose) > analysis::kMostLoose) return false;
        loose_ = std::move(loose);
        for (std::size_t b = 0; b < gone_.size(); ++b) gone_[b] = gone_[b] || loose_[b];
        return true;
    }

    SearchResult named(SearchResult result) const {
        for (std::size_t b = 0; b < loose_.size(); ++b)
            if (loose_[b]) result.fallen_at_start.push_back(model_.blocks[b].name);
        std::sort(result.fallen_at_start.begin(), result.fallen_at_start.end());
        if (result.fallen_at_start.empty()) return result;
        result.failing = nullptr;  // its blocks are not the model's
        result.warnings.push_back(std::to_string(result.fallen_at_start.size()) +
                                  " of the blocks fall at the start whatever the strength (" +
                                  result.fallen_at_start.front() +
                                  " for one): the answer is for the rest, without them");
        return result;
    }

    const Model& model_;
    const Axis& axis_;
    const Control& control_;
    const QuasiStatic& settings_;
    std::vector<char> gone_;     ///< per block: not in the search
    std::vector<char> loose_{};  ///< per block: because it falls; empty: none
};

Result<SearchResult> search(const Model& model, const Axis& axis, const Control& control,
                            const QuasiStatic& settings, const std::vector<std::string>& without = {}) {
    return analysis::inArena(control.threads, [&]() -> Result<SearchResult> {
        const auto begin = std::chrono::steady_clock::now();
        Result<SearchResult> result = SearchOfTheRest(model, axis, control, settings, without).run();
        if (!result) return result;
        result->wall_seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        return result;
    });
}

/// The groups that go one after the other: the search is made again without those that have gone. What then falls at
/// the start whatever the strength goes with the group before it; a group that fails at a lower factor than the one
/// before goes at that one's.
void addGroups(const Model& model, const Axis& axis, const Control& control, const QuasiStatic& settings,
               SearchResult& result) {
    if (result.status != SearchStatus::found) return;
    result.groups.push_back({result.answer, result.moving_blocks});
    std::vector<std::string> gone = result.fallen_at_start;
    const auto goes = [&](const std::vector<std::string>& blocks) {
        gone.insert(gone.end(), blocks.begin(), blocks.end());
    };
    goes(result.moving_blocks);
    const auto free = static_cast<std::size_t>(
        std::count_if(model.blocks.begin(), model.blocks.end(),
                      [](const Block& block) { return block.motion == Motion::free; }));
    while (static_cast<int>(result.groups.size()) < control.groups && gone.size() < free &&
           !stopped(control)) {
        const Result<SearchResult> next = search(model, axis, control, settings, gone);
        if (!next) return;
        result.steps += next->steps;
        result.wall_seconds += next->wall_seconds;
        BlockGroup& last = result.groups.back();
        last.blocks.insert(last.blocks.end(), next->fallen_at_start.begin(), next->fallen_at_start.end());
        std::sort(last.blocks.begin(), last.blocks.end());
        if (!claimsFailure(*next) || next->moving_blocks.empty()) return;
        const double factor = next->status == SearchStatus::found ? next->answer : last.factor;
        result.groups.push_back({std::max(factor, last.factor), next->moving_blocks});
        goes(next->fallen_at_start);
        goes(next->moving_blocks);
    }
}

/// Halvings of `step` until it is no wider than the tolerance.
int halvings(double step, double tolerance) {
    return std::max(0, static_cast<int>(std::ceil(std::log2(step / tolerance) - 1e-9)));
}

}  // namespace

Result<SearchResult> criticalAngle(const Model& model, const Control& control, const QuasiStatic& settings) {
    Axis axis;
    axis.start = model.analysis.start.value_or(model.gravity.tilt);
    const double step = (model.analysis.stop - axis.start) / 8;
    const std::int64_t cells = std::int64_t{1} << halvings(step, model.analysis.tolerance);
    axis.cell = step / static_cast<double>(cells);
    axis.stop = 8 * cells;
    axis.imbalance_tolerance = axis.cell;  // out-of-balance force over weight changes like the tilt [rad]
    axis.next = [cells](std::int64_t cell) { return cell + cells; };
    axis.apply = [](State& state, double tilt) { state.load.tilt = tilt; };
    axis.say = [](double tilt) { return formatted("tilt %.4f deg", degrees(tilt)); };
    return search(model, axis, control, settings);
}

Result<SearchResult> safetyFactor(const Model& model, const Control& control, const QuasiStatic& settings) {
    constexpr double kStart = analysis::kTenfoldStrength;  // then twice the factor until it fails
    constexpr int kDoublings = 10;
    Axis axis;
    axis.start = kStart;
    axis.tenfold_at_start = true;
    const std::int64_t cells = std::int64_t{1} << halvings(kStart, model.analysis.factor_tolerance);
    axis.cell = kStart / static_cast<double>(cells);
    axis.stop = ((std::int64_t{1} << kDoublings) - 1) * cells;
    // The driving force is at most the weight, so a change of F by a cell is worth at most that share of it.
    axis.imbalance_tolerance = 0.1 * axis.cell;
    axis.next = [cells](std::int64_t cell) { return 2 * cell + cells; };
    axis.apply = [&model](State& state, double factor) { state.laws = jointLaws(model.joints, factor); };
    axis.say = [](double factor) { return formatted("factor %.4f", factor); };
    Result<SearchResult> result = search(model, axis, control, settings);
    if (result) addGroups(model, axis, control, settings, *result);
    return result;
}

Result<SearchResult> criticalAcceleration(const Model& model, const Control& control,
                                          const QuasiStatic& settings) {
    constexpr double kStep = 0.1;  // then twice as far on until it fails
    constexpr int kDoublings = 10;
    Axis axis;
    axis.start = model.seismic.horizontal;
    const std::int64_t cells = std::int64_t{1} << halvings(kStep, model.analysis.acceleration_tolerance);
    axis.cell = kStep / static_cast<double>(cells);
    axis.stop = ((std::int64_t{1} << kDoublings) - 1) * cells;
    axis.imbalance_tolerance = axis.cell;  // out-of-balance force over weight changes like the coefficient
    axis.next = [cells](std::int64_t cell) { return 2 * cell + cells; };
    axis.apply = [](State& state, double horizontal) { state.load.horizontal = horizontal; };
    axis.say = [](double horizontal) { return formatted("horizontal %.5f of the weight", horizontal); };
    return search(model, axis, control, settings);
}

const char* toString(SearchStatus status) {
    switch (status) {
        case SearchStatus::found:
            return "found";
        case SearchStatus::unstable_at_start:
            return "unstable_at_start";
        case SearchStatus::stable_to_stop:
            return "stable_to_stop";
        case SearchStatus::interrupted:
            return "undecided";
        case SearchStatus::undecided:
            break;
    }
    return "undecided";
}

const char* toString(FailureMode mode) {
    switch (mode) {
        case FailureMode::sliding:
            return "sliding";
        case FailureMode::toppling:
            return "toppling";
        case FailureMode::mixed:
            return "mixed";
        case FailureMode::none:
            break;
    }
    return "none";
}

const char* toString(Verdict verdict) {
    switch (verdict) {
        case Verdict::stable:
            return "stable";
        case Verdict::failing:
            return "failing";
        case Verdict::undecided:
            break;
    }
    return "undecided";
}

}  // namespace talus
