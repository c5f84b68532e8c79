#include "analysis/load_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include "analysis/bracket.h"
#include "analysis/failure_mode.h"
#include "analysis/quasi_static.h"
#include "forces/bolts.h"
#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "frame/frame.h"
#include "measure/measure.h"
#include "state/incidence.h"

namespace talus::analysis {
namespace {

constexpr double kOverload = 8.0;    // cells beyond the failing load at which the continuation runs
constexpr int kMostReopenings = 12;  // times a failing motion may come to rest before the search gives up
// Steps of a probe before the implicit solve is asked; slides need 1,000 to 5,000.
constexpr std::int64_t kFirstSteps = 6'000;
// Factorisations that one may take: about as long as the steps so far, at least a number that decides most.
constexpr std::int64_t kLeastFactors = 30, kMostFactors = 600, kStepsPerFactor = 2000;
// Rest is near when it is no farther than this times the way the assembly has come, from rest to rest (engine/README.md says what
// smaller and larger ones do).
constexpr double kNear = 1.5;
constexpr double kSettlingDrag = 0.125;
constexpr double kSettlingPeriods = 3.0;
constexpr double kStartPeriods = 20.0;  // nothing is known of the slowest period yet but a guess
// A failure is a failure when blocks have been seen to go this share of their size and gather speed. Near the critical
// load that takes long; at the start, where no deflection at rest is known to compare with, more is asked for.
constexpr double kSeenShare = 2e-4, kSeenAtStart = 0.01;
// Steps of the continuation: as many as the probes took, but a number that shows something, and not without bound.
constexpr std::int64_t kLeastSteps = 40'000, kMostSteps = 400'000, kMostStepsAtStart = 100'000;

class Search {
 public:
    Search(const State& state, const LoadAxis& axis, const Control& control, const QuasiStatic& settings,
           bool parallel)
        : axis_(axis),
          control_(control),
          parallel_(parallel),
          bracket_(axis.stop),
          last_stable_(state),
          work_(prepare(last_stable_, settings, control, axis.imbalance_tolerance, parallel)),
          reach_(tieReach(state)),
          implicit_first_(reach_ > 0) {}

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
    Verdict probe(const std::string& stage, double load, const Ramp& ramp) {
        if (implicit_first_)
            if (const Verdict found = probeImplicitly(stage, load, ramp); found != Verdict::undecided)
                return found;
        QuasiStaticWork work = work_;
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

    void keepLearnt(const QuasiStaticWork& work) {
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
        return result_.low == -kInfinity || probe.displacement <= nearLimit(last_stable_);
    }

    /// Without the way on which bolts took hold: then what the assembly gave at its start [m].
    double ownDeflection() const { return reach_ > 0 ? std::min(settlement_, deflection()) : deflection(); }

    /// From a state. Bolts hold only as far as blocks have moved, so that way is none of a failure.
    double nearLimit(const State& from) const {
        return std::max(kSeenShare * from.geometry->length_scale, kNear * ownDeflection()) + tieReach(from);
    }

    /// Of the farthest-moved block [m].
    static double wayBetween(const State& from, const State& to) {
        double farthest = 0;
        for (std::size_t b = 0; b < from.blocks.size(); ++b)
            farthest = std::max(farthest, (to.blocks.position.get(b) - from.blocks.position.get(b)).norm());
        return farthest;
    }

    /// From the last stable state, the whole change of load at once.
    Verdict probeImplicitly(const std::string& stage, double load, const Ramp& ramp, bool patiently = false) {
        const bool doubtful = patiently || implicit_first_ || result_.low == -kInfinity;
        const std::int64_t most_factors =
            doubtful ? kMostFactors : std::clamp(probe_steps_ / kStepsPerFactor, kLeastFactors, kMostFactors);
        State state = last_stable_;
        ramp(state, 1.0);
        Probe found = findRest(state, work_, most_factors);
        const bool is_elsewhere = found.verdict == Verdict::stable && !isNear(found);
        if (is_elsewhere) {
            found.verdict = Verdict::failing;
            stands_elsewhere_ = true;
            found.reason = "moves " + formatted("%.2g", found.displacement) + " m to where it stands again";
            state = last_stable_;
            ramp(state, 1.0);
        }
        if (found.verdict == Verdict::failing)
            no_near_rest_ = {load, most_factors, states_at_rest_, is_elsewhere};
        return keep(stage, load, found, state);
    }

    Verdict probe(const std::string& stage, double load, State state, QuasiStaticWork& work,
                  const Ramp& ramp) {
        return keep(stage, load, bringOn(state, work, ramp), state);
    }

    Verdict keep(const std::string& stage, double load, Probe probe, State& state) {
        probe.load = load;
        probe_steps_ += probe.steps;
        result_.factors += probe.factors;
        result_.probes.push_back(probe);
        report(stage, load, probe.verdict);
        if (probe.verdict == Verdict::stable) ++states_at_rest_;
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
            learnPeriod(work_, unloaded, last_stable_);
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
    Verdict bringOnInParts(const std::string& stage, std::span<const double> parts, const Ramp& load) {
        Verdict verdict = Verdict::stable;
        double from = 0;
        for (const double to : parts) {
            if (verdict != Verdict::stable || interrupted()) break;
            const State before = last_stable_;
            verdict = probe(stage, axis_.start,
                            [&](State& state, double share) { load(state, from + share * (to - from)); });
            if (verdict == Verdict::failing && settles(last_moving_, axis_.start, kStartPeriods)) {
                learnPeriod(work_, before, last_stable_);
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
        takeBack(moved, work_);
        if (!settles(moved, axis_.start, kStartPeriods)) return false;
        const bool dry = !last_stable_.geometry->model.hasWater() || last_stable_.load.water_share == 1;
        return dry || loadWater() == Verdict::stable;
    }

    /// Gravity at the start, then water. True when the assembly stands.
    bool loadGravityAndWater() {
        axis_.apply(last_stable_, axis_.start);
        start_tilt_ = last_stable_.load.tilt;
        last_stable_.load.gravity_share = last_stable_.load.water_share = 0;
        Verdict verdict = loadGravity();
        if (verdict == Verdict::stable && last_stable_.geometry->model.hasWater()) verdict = loadWater();
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
        takeBack(moved, work_);
        return !settles(moved, load);
    }

    /// What the implicit solve finds at the failing load, given its time: blocks that topple may have been shaken there
    /// by the explicit steps.
    Verdict restAt(double load) {
        const bool is_known = no_near_rest_.load == load && no_near_rest_.most_factors == kMostFactors &&
                              no_near_rest_.states_at_rest == states_at_rest_;
        if (is_known) {
            stands_elsewhere_ = no_near_rest_.is_elsewhere;
            no_rest_ = !stands_elsewhere_;
            return Verdict::failing;
        }
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
        QuasiStaticWork patient = analysis::patient(work_, kSettlingDrag, watch_periods);
        const auto hold = [](State&, double) {};
        const State before = last_stable_;
        if (probe("settling", load, moving, patient, hold) != Verdict::stable) return false;
        if (result_.low == -kInfinity || wayBetween(before, last_stable_) <= nearLimit(before)) return true;
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
        if (!fails) result_.bolts = bolts::report(last_stable_);
        result_.steps = steps();
        result_.state_hash = stateHash(last);
        result_.inertia_scaled = work_.inertia_scaled;
        result_.damping_local = work_.settings.local_damping;
        result_.blocks = last.blocks.size();
        const ContactCount contacts = countContacts(last.interfaces);
        result_.interfaces = contacts.interfaces;
        result_.contact_points = contacts.points;
        result_.warnings = last.warnings;
        warnOfSoftJoints(last);
        if (fails) warnOfLostCohesion(last);
    }

    /// Share of the area of joints whose cohesion goes at the first slip that has lost it, 0..1.
    static double lostCohesion(const State& state) {
        double all = 0, lost = 0;
        for (std::size_t i = 0; i < state.interfaces.size(); ++i) {
            const contact::JointLaw& law = state.laws[static_cast<std::size_t>(state.interfaces.joint[i])];
            if (!(law.cohesion > law.residual_cohesion) || isIdle(state.interfaces, i)) continue;
            for (const ContactPoint& point : contactPoints(state, i)) {
                all += point.area;
                lost += (1 - point.memory.bond) * point.area;
            }
        }
        return all > 0 ? lost / all : 0.0;
    }

    /// Limit equilibrium keeps cohesion to the end; eq 9 does not.
    void warnOfLostCohesion(const State& state) {
        const double lost = lostCohesion(state);
        if (lost == 0) return;
        result_.warnings.push_back(
            "the answer hangs on cohesion that is lost where a joint first slips or opens (" +
            formatted("%.0f", 100 * lost) +
            " % of its area in the failure): with residual_cohesion = cohesion, as limit equilibrium has it, "
            "it "
            "may be higher; the ceiling of limit analysis counts it as kept");
    }

    /// The formulas are for joints that do not give.
    void warnOfSoftJoints(const State& state) {
        constexpr double kSoft = 1e-4;  // of the block size
        if (reach_ > 0) return;         // blocks that move until their bolts hold say nothing of joints
        const double deflected = deflection();
        if (deflected <= kSoft * state.geometry->length_scale) return;
        result_.warnings.push_back(
            "the joints are soft against the stress on them: blocks move by " + formatted("%.2g", deflected) +
            " m before they fail, so toppling blocks turn about points inside their edges, and "
            "formulas for rigid joints give higher values");
    }

    /// What is to be seen of a failure: at the start, a block that has gone a share of its size; else less of that, but
    /// several times what the assembly has moved at rest. What it has crept from rest to rest is not asked for again
    /// where no rest is found by either way.
    Evidence evidence() const {
        const std::int64_t most = std::clamp(probe_steps_, kLeastSteps, kMostSteps);
        if (!bracket_.high())
            return {.deflection = 0, .share = kSeenAtStart, .most_steps = kMostStepsAtStart};
        const double settled = std::max(kSeenShare * last_stable_.geometry->length_scale, settlement_);
        const double own = ownDeflection();
        const double deflected = no_rest_ ? std::min(own, settled) : own;
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
        result_.bolts = bolts::report(last_moving_);
        Failure failure = continueFailure(last_moving_, evidence(), control_, parallel_);
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

    /// The last load at which the implicit solve found no rest nearby, and from which state: it would find the same again.
    struct NoNearRest {
        double load = -kInfinity;
        std::int64_t most_factors = 0;
        std::int64_t states_at_rest = 0;
        bool is_elsewhere = false;
    };

    const LoadAxis& axis_;
    const Control& control_;
    bool parallel_;
    Bracket bracket_;
    State last_stable_;
    State last_moving_;
    QuasiStaticWork work_;
    SearchResult result_;
    double start_tilt_ = 0;  ///< [rad]
    double settlement_ = 0;  ///< under weight and water at the start [m]
    std::vector<std::size_t> falling_{};
    bool stands_elsewhere_ =
        false;              ///< the implicit solve found an equilibrium at the failing load, but not near
    bool no_rest_ = false;  ///< nor any other there
    NoNearRest no_near_rest_;
    std::int64_t states_at_rest_ = 0;  ///< the search has been in
    double reach_;                     ///< of the bolts at the beginning [m]
    /// explicit steps have not been enough, or will not be: bolts take hold over ways that they are slow to go
    bool implicit_first_ = false;
    std::int64_t probe_steps_ = 0, continuation_steps_ = 0;
};

}  // namespace

Outcome searchLoad(const State& state, const LoadAxis& axis, const Control& control,
                   const QuasiStatic& settings, bool parallel) {
    Search search(state, axis, control, settings, parallel);
    SearchResult result = search.run();
    return {std::move(result), search.falling()};
}

Start loadStart(const State& state, const LoadAxis& axis, const Control& control, const QuasiStatic& settings,
                bool parallel) {
    Search search(state, axis, control, settings, parallel);
    search.start();
    return {search.falling(), search.steps()};
}

}  // namespace talus::analysis
