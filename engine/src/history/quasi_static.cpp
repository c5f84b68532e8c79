#include "history/quasi_static.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "checks/plausible.h"
#include "contacts/update.h"
#include "equilibrium/first_order_gaps.h"
#include "forces/sum.h"
#include "law/law.h"
#include "measure/measure.h"
#include "state/block_motion.h"
#include "state/caller.h"
#include "step/step.h"
#include "step/time_step.h"

namespace talus::history {
namespace {

// With more moving blocks, pairs more often want a new contact of faces, and the search, which serves all,
// takes longer. So a pair waits one step for every so many free blocks. With 4,775 blocks and no waiting,
// searches took three quarters of the time; pairs of small models do not wait.
constexpr std::int64_t kBlocksPerWait = 25;
constexpr double kFailedBy = 0.1;     // of a block's own size: it has failed
constexpr int kStepsPerGlance = 100;  // ... checked at this interval
constexpr double kShareOfTolerance =
    0.01;  // in equilibrium the imbalance is equivalent to this share of the load's tolerance
constexpr double kSlowPeriodGrowth = 8.0;  // slip makes the observed period longer; upper bound of that

/// Whether a block has moved so far that the assembly is no longer the one that was loaded. It may be in
/// equilibrium: a fallen block may lie still at the foot of the slope.
bool hasFailed(const State& state, const SettlingStart& start) {
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        const double way = wayFrom(start.position, start.orientation, state, b);
        if (way > kFailedBy * state.geometry->size[b] + start.reach) return true;
    }
    return false;
}

/// Weight and water on the blocks, for the estimate of the period [N].
std::vector<Vec3> externalLoad(const State& state) {
    std::vector<Vec3> load;
    const Vec3 g = bodyAcceleration(state);
    for (std::size_t b = 0; b < state.blocks.size(); ++b) load.push_back(appliedOn(state, b, g).force);
    return load;
}

/// Rayleigh's quotient of the displacement that a change of load has caused: omega^2 = (f . u) / (u . M u).
/// Returns the period [s], 0 when the change of load did no work.
double observedPeriod(const State& state, const PositionArray& position_before,
                      const std::vector<Vec3>& before) {
    const std::vector<Vec3> now = externalLoad(state);
    double work = 0, inertia = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        const Vec3 u = state.blocks.position.get(b) - position_before.get(b);
        work += u.dot(now[b] - before[b]);
        inertia += u.squaredNorm() / state.blocks.inverse_mass[b];
    }
    return work > 0 ? 2.0 * M_PI * std::sqrt(inertia / work) : 0.0;
}

bool interrupted(const QuasiStaticWork& work) { return isStopped(*work.control); }

/// Every block at the same stability bound; one number per block.
std::vector<double> inertiaScale(const QuasiStaticWork& work, const std::vector<double>& bounds) {
    std::vector<double> scale(bounds.size(), 1.0);
    if (work.inertia_scaled)
        for (std::size_t b = 0; b < bounds.size(); ++b)
            if (bounds[b] > 0) scale[b] = bounds[b] / work.frequency_bound;
    return scale;
}

/// New contacts may be stiffer than the inertia or the time step was made for.
void fitToContacts(State& state, QuasiStaticWork& work) {
    const std::vector<double> bounds = frequencyBounds(state, work.parallel);
    if (work.inertia_scaled) {
        work.inertia_scale = inertiaScale(work, bounds);
        setInertia(state, work.inertia_scale);
        return;
    }
    const double highest = *std::max_element(bounds.begin(), bounds.end());
    if (highest > 0) work.time_step = work.settings.step_safety * stableTimeStep(highest, 0.0);
}

/// Quasi-static work has no time, so driven blocks do not move.
void stopDrivenBlocks(State& state) {
    bool any = false;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::driven) continue;
        any = true;
        state.blocks.velocity.set(b, Vec3::Zero());
    }
    if (any) state.warnings.push_back("driven blocks do not move in this analysis");
}

/// Brittle strength must not be lost by an artefact of loading: a load applied within some periods
/// overshoots, and opens joints that it only presses together. So equilibrium is found first with all bonds
/// unbreakable; then overloaded bonds break from there.
class HeldBonds {
 public:
    explicit HeldBonds(State& state)
        : state_(state), any_(std::any_of(state.laws.begin(), state.laws.end(), contact::isBrittle)) {
        hold();
    }
    ~HeldBonds() { unclamp(); }
    HeldBonds(const HeldBonds&) = delete;
    HeldBonds& operator=(const HeldBonds&) = delete;

    bool areHeld() const { return held_; }

    void hold() {
        if (!any_ || held_) return;
        laws_ = state_.laws;
        std::transform(laws_.begin(), laws_.end(), state_.laws.begin(), contact::held);
        held_ = true;
    }
    void unclamp() {
        if (!held_) return;
        state_.laws.swap(laws_);
        held_ = false;
    }

 private:
    State& state_;
    std::vector<contact::JointLaw> laws_{};
    bool any_, held_ = false;
};

void takeSteps(State& state, QuasiStaticWork& work, Settling& settling, const SetLoad& set_load = {}) {
    advance(state, {work.time_step, work.parallel}, kStepsPerSample, set_load);
    settling.steps += kStepsPerSample;
    work.steps += kStepsPerSample;
    const bool may_wait = work.steps - work.searched_at < work.pair_waits;
    if (!refreshInterfaces(state, work.parallel, kStepsPerSample * work.time_step, work.control->stop, {},
                           may_wait))
        return;
    work.searched_at = work.steps;
    fitToContacts(state, work);
}

Watch watchOf(const State& state, const QuasiStaticWork& work) {
    const auto steps_per_period = static_cast<int>(std::ceil(work.slow_period / work.time_step));
    return {state, work.out_of_balance_limit, steps_per_period, work.settings.watch_periods};
}

/// The load stays as it is.
void watchUntilDecided(State& state, QuasiStaticWork& work, Watched& watched, Settling& settling) {
    const auto steps_per_tuning =
        std::max<std::int64_t>(20, std::llround(0.25 * work.slow_period / work.time_step));
    bool decided = false;
    while (!decided && !interrupted(work) && settling.steps < work.settings.most_steps) {
        takeSteps(state, work, settling);
        decided = watched.watch.look(state, settling);
        if (!decided && settling.steps % kStepsPerGlance == 0 && hasFailed(state, watched.start)) {
            settling.verdict = Verdict::failing;
            settling.reason =
                describe("a block is displaced by more than a tenth of its size: out-of-balance force",
                         settling.out_of_balance, settling.steps);
            decided = true;
        }
        watched.steps_since_tuning += kStepsPerSample;
        if (watched.steps_since_tuning < steps_per_tuning) continue;
        watched.tuner.tune(state, work.settings.drag_ratio, work.slow_period);
        watched.steps_since_tuning = 0;
    }
    if (!decided) {
        settling.reason = interrupted(work) ? "interrupted"
                                            : describe("still moving: out-of-balance force",
                                                       settling.out_of_balance, settling.steps);
    }
}

/// To equilibrium with bonds held, where there are any, and from there without.
void decide(State& state, QuasiStaticWork& work, HeldBonds& bonds, Watched& watched, Settling& settling) {
    watchUntilDecided(state, work, watched, settling);
    if (bonds.areHeld() && settling.verdict == Verdict::stable) {
        bonds.unclamp();
        settling.verdict = Verdict::undecided;
        watched = {std::move(watched.start), watchOf(state, work), DragTuner(state)};
        watchUntilDecided(state, work, watched, settling);
    }
    const SettlingStart& start = watched.start;
    settling.displacement = largestMotion(state, start.position, start.orientation);
    if (settling.verdict != Verdict::stable) return;
    setAtRest(state.blocks);
    const double period = observedPeriod(state, start.position, start.load);
    work.slow_period = std::clamp(period, work.slow_period, work.slow_period_limit);
}

}  // namespace

QuasiStaticWork prepare(State& state, const QuasiStatic& settings, const Control& control,
                        double load_tolerance, bool parallel) {
    QuasiStaticWork work{.settings = settings, .control = &control, .parallel = parallel};
    const std::vector<double> bounds = frequencyBounds(state, parallel);
    const double highest = *std::max_element(bounds.begin(), bounds.end());
    const double bound = highest > 0 ? highest : 1.0;
    work.frequency_bound = bound;
    work.time_step = settings.step_safety * stableTimeStep(bound, 0.0);
    work.inertia_scaled = state.geometry->model.analysis.time_scaling;
    work.inertia_scale = inertiaScale(work, bounds);
    work.damping = {.local = settings.local_damping};
    stopDrivenBlocks(state);
    // A first guess that the gravity loading corrects: an assembly n blocks across has a slowest period of
    // about 2 n times its fastest.
    const double across = std::cbrt(static_cast<double>(state.blocks.size()));
    work.slow_period = 4.0 * across * 2.0 * M_PI / std::sqrt(bound);
    work.slow_period_limit = kSlowPeriodGrowth * work.slow_period;
    work.out_of_balance_limit =
        std::max(kShareOfTolerance * load_tolerance, checks::roundingLevel(state, bounds));
    if (work.out_of_balance_limit > load_tolerance)
        state.warnings.push_back(
            "stiffness, coordinates, or the blocks that support others are so large that rounding keeps the "
            "out-of-balance force at " +
            std::to_string(work.out_of_balance_limit) +
            " of the weight: the answer is no more accurate than that");
    work.release = std::min(1.0, work.time_step / (2.0 * work.slow_period));
    const auto free = std::count(state.blocks.motion.begin(), state.blocks.motion.end(), Motion::free);
    work.pair_waits = free / kBlocksPerWait;
    takeBack(state, work);
    return work;
}

void takeBack(State& state, const QuasiStaticWork& work) {
    setAtRest(state.blocks);
    setInertia(state, work.inertia_scale);
    state.damping = work.damping;
    state.release = work.release;
}

Settling bringOn(State& state, QuasiStaticWork& work, const Ramp& ramp) {
    Settling settling;
    DragTuner::setDrag(state, work.settings.drag_ratio, work.slow_period);
    SettlingStart start{state.blocks.position, state.blocks.orientation, externalLoad(state),
                        tieReach(state)};
    const auto ramp_samples = std::max<std::int64_t>(
        2, std::llround(work.settings.ramp_periods * work.slow_period / (kStepsPerSample * work.time_step)));
    const auto ramp_steps = static_cast<double>(ramp_samples * kStepsPerSample);
    HeldBonds bonds(state);
    const SetLoad set_load = [&](int k) {
        bonds.unclamp();
        ramp(state, static_cast<double>(settling.steps + k + 1) / ramp_steps);
        bonds.hold();
    };
    for (std::int64_t sample = 0; sample < ramp_samples && !interrupted(work); ++sample)
        takeSteps(state, work, settling, set_load);
    Watched watched{std::move(start), watchOf(state, work), DragTuner(state)};
    decide(state, work, bonds, watched, settling);
    return settling;
}

}  // namespace talus::history
