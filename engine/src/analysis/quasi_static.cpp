#include "analysis/quasi_static.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "analysis/plausible.h"
#include "analysis/stopwatch.h"
#include "contacts/update.h"
#include "equilibrium/find_equilibrium.h"
#include "equilibrium/first_order_gaps.h"
#include "forces/sum.h"
#include "law/law.h"
#include "measure/measure.h"
#include "state/block_motion.h"
#include "state/caller.h"
#include "step/step.h"
#include "step/time_step.h"

namespace talus::analysis {
namespace {

// The more blocks move, the more often a pair of them wants its contact of faces made anew, and the longer takes the search, which serves
// all: a pair waits a step for so many free blocks. Of 4,775 searches at once took three quarters of the time; few blocks do not wait.
constexpr std::int64_t kBlocksPerWait = 25;
constexpr int kStepsPerSample =
    10;  // neighbours, patches and the out-of-balance force are looked at this often
constexpr int kLeastStepsPerWindow = 100;
constexpr double kFlat = 0.03;     // spread of the out-of-balance force over its mean, within a window
constexpr double kEven = 0.01;     // change of the motion from window to window: it goes on at the same speed
constexpr double kLevel = 0.05;    // change of the mean from window to window on a plateau with some noise
constexpr int kLevelWindows = 3;   // as many such windows in a row
constexpr int kWindowsInSpan = 4;  // where it is not flat: windows per span, and spans are compared
constexpr double kPlateau = 0.8;   // out-of-balance force of a span over that of the span before
constexpr double kSteady = 0.9;    // motion of a window over that of the window before: it does not slow down
constexpr double kGone = 0.1;      // of a block's own size: it has left its place
constexpr int kStepsPerGlance = 100;  // ... which is looked at this often
constexpr double kShareOfTolerance =
    0.01;  // at rest, the imbalance is worth this share of the load's tolerance
constexpr double kSlowPeriodGrowth = 8.0;  // slip makes the observed period longer; not without bound
constexpr double kSlowestMotion = 32.0;    // slowest motion the drag is tuned to, in slowest periods

/// Whether a block has gone so far that, come to rest or not, the assembly is no longer the one that was loaded: what
/// has fallen off may lie still at the foot of the slope.
/// \param reach  of the bolts when it was loaded [m]
bool hasGone(const State& state, const PositionArray& position, const QuaternionArray& orientation,
             double reach) {
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        if (wayFrom(position, orientation, state, b) > kGone * state.geometry->size[b] + reach) return true;
    }
    return false;
}

/// What is seen of the out-of-balance force over some time.
struct Window {
    double sum = 0, least = kInfinity, most = 0;
    double motion = 0;  ///< of the farthest-moved block [m]
    int samples = 0;

    void add(double ratio) {
        sum += ratio;
        least = std::min(least, ratio);
        most = std::max(most, ratio);
        ++samples;
    }
    double mean() const { return sum / samples; }
};

/// Load on the blocks that an analysis controls: weight and water, for the period estimate.
struct ExternalLoad {
    std::vector<Vec3> force;
};

ExternalLoad externalLoad(const State& state) {
    ExternalLoad load;
    const Vec3 g = bodyAcceleration(state);
    for (std::size_t b = 0; b < state.blocks.size(); ++b) load.force.push_back(appliedOn(state, b, g).force);
    return load;
}

/// Rayleigh's quotient of the displacement that a change of load has caused: omega^2 = (f . u) / (u . M u). Returns the
/// period [s], 0 when the change of load did no work.
double observedPeriod(const State& state, const PositionArray& position_before, const ExternalLoad& before) {
    const ExternalLoad now = externalLoad(state);
    double work = 0, inertia = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        const Vec3 u = state.blocks.position.get(b) - position_before.get(b);
        work += u.dot(now.force[b] - before.force[b]);
        inertia += u.squaredNorm() / state.blocks.inverse_mass[b];
    }
    return work > 0 ? 2.0 * M_PI * std::sqrt(inertia / work) : 0.0;
}

std::string describe(const char* what, double out_of_balance, std::int64_t steps) {
    char text[160];
    std::snprintf(text, sizeof text, "%s %.2e of the weight after %lld steps", what, out_of_balance,
                  static_cast<long long>(steps));
    return text;
}

/// Watches an assembly under constant load until its verdict is clear.
class Watch {
 public:
    Watch(const State& state, const QuasiStaticWork& work)
        : state_(state),
          limit_(work.out_of_balance_limit),
          steps_per_period_(static_cast<int>(std::ceil(work.slow_period / work.time_step))),
          samples_per_window_(std::max(kLeastStepsPerWindow,
                                       static_cast<int>(work.settings.watch_periods * steps_per_period_)) /
                              kStepsPerSample),
          position_(state.blocks.position),
          orientation_(state.blocks.orientation) {}

    /// Looks once more; true when the verdict in `probe` is final.
    bool look(Probe& probe) {
        const double ratio = outOfBalanceRatio(state_);
        probe.out_of_balance = ratio;
        window_.add(ratio);
        span_.add(ratio);
        quiet_steps_ = ratio < limit_ ? quiet_steps_ + kStepsPerSample : 0;
        if (quiet_steps_ >= std::max(steps_per_period_, 2 * kStepsPerSample)) {
            probe.verdict = Verdict::stable;
            probe.reason = describe("at rest: out-of-balance force stays below", ratio, probe.steps);
            return true;
        }
        if (window_.samples < samples_per_window_) return false;
        return closeWindow(probe);
    }

 private:
    bool closeWindow(Probe& probe) {
        const double motion = largestMotion(state_, position_, orientation_);
        window_.motion = motion - last_motion_;
        const bool steady = window_.mean() > limit_ && last_window_.samples > 0 &&
                            window_.motion > kSteady * last_window_.motion;
        const bool flat = steady && window_.most - window_.least < kFlat * window_.mean() &&
                          window_.mean() > (1.0 - kFlat) * last_window_.mean();
        // The speed tells what the noise of the force hides: where a spring acts it falls, however slow the mode.
        const bool even = steady && last_window_.motion > 0 &&
                          std::abs(window_.motion - last_window_.motion) < kEven * last_window_.motion &&
                          window_.mean() > (1.0 - kLevel) * last_window_.mean();
        const bool level =
            steady && std::abs(window_.mean() - last_window_.mean()) < kLevel * last_window_.mean();
        level_windows_ = level ? level_windows_ + 1 : 0;
        last_window_ = window_;
        last_motion_ = motion;
        window_ = {};
        if (flat || even || level_windows_ == kLevelWindows) return fails(probe, last_window_);
        return ++windows_ % kWindowsInSpan == 0 && closeSpan(probe, motion);
    }

    /// A noisy plateau, seen over a longer time.
    bool closeSpan(Probe& probe, double motion) {
        span_.motion = motion - last_span_motion_;
        const bool plateau = last_span_.samples > 0 && span_.mean() > limit_ &&
                             span_.mean() > kPlateau * last_span_.mean() &&
                             span_.motion > kSteady * last_span_.motion;
        last_span_ = span_;
        last_span_motion_ = motion;
        span_ = {};
        return plateau && fails(probe, last_span_);
    }

    bool fails(Probe& probe, const Window& seen) {
        probe.verdict = Verdict::failing;
        probe.out_of_balance = seen.mean();
        probe.reason = describe("moves on: out-of-balance force stays at", seen.mean(), probe.steps);
        return true;
    }

    const State& state_;
    double limit_;
    int steps_per_period_, samples_per_window_;
    int quiet_steps_ = 0, windows_ = 0, level_windows_ = 0;
    Window window_, last_window_, span_, last_span_;
    double last_motion_ = 0, last_span_motion_ = 0;
    PositionArray position_;
    QuaternionArray orientation_;
};

/// Tunes the drag to the motion that is going on: Rayleigh's quotient of the displacement since the last look and of
/// the force it met, omega^2 = -(dF . du) / (du . M du) (Underwood 1983). Where columns lean on each other a mode can
/// be many times slower than the estimate, and would creep under a drag meant for a faster one.
class DragTuner {
 public:
    explicit DragTuner(const State& state) { remember(state); }

    void tune(State& state, const QuasiStaticWork& work) {
        double stiffness = 0, inertia = 0;
        const Vec3 g = bodyAcceleration(state);
        for (std::size_t b = 0; b < state.blocks.size(); ++b) {
            if (state.blocks.motion[b] != Motion::free) continue;
            const Vec3 u = state.blocks.position.get(b) - position_.get(b);
            stiffness -= u.dot(outOfBalance(state, b, g).force - force_[b]);
            inertia += u.squaredNorm() / state.blocks.inverse_mass[b];
        }
        // Motion that meets no resistance is a failure, and needs its drag to stay free of rattle.
        const double slowest = kSlowestMotion * work.slow_period;
        const double period = stiffness > 0 ? 2.0 * M_PI * std::sqrt(inertia / stiffness) : kInfinity;
        setDrag(state, work, period < slowest ? std::max(period, work.slow_period) : work.slow_period);
        remember(state);
    }

    /// Drag at a share of what is critical for a mode of this period: c = 2 ratio omega.
    static void setDrag(State& state, const QuasiStaticWork& work, double period) {
        state.damping.mass = state.damping.rotation = 4.0 * M_PI * work.settings.drag_ratio / period;
    }

 private:
    void remember(const State& state) {
        position_ = state.blocks.position;
        force_.resize(state.blocks.size());
        const Vec3 g = bodyAcceleration(state);
        for (std::size_t b = 0; b < force_.size(); ++b) force_[b] = outOfBalance(state, b, g).force;
    }

    PositionArray position_;
    std::vector<Vec3> force_{};
};

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

/// Quasi-static work has no time in which a driven block could move.
void stopDrivenBlocks(State& state) {
    bool any = false;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::driven) continue;
        any = true;
        state.blocks.velocity.set(b, Vec3::Zero());
    }
    if (any) state.warnings.push_back("driven blocks stand still in this analysis");
}

/// Strength that is lost for good must not be lost on a way that rock does not go: what is laid on within some periods, and
/// comes to rest under a drag, overshoots, and opens joints that the load only presses together. So rest is found with
/// all that is whole held together, and what the load is too much for then breaks from there.
class HeldBonds {
 public:
    explicit HeldBonds(State& state)
        : state_(state), any_(std::any_of(state.laws.begin(), state.laws.end(), contact::isBrittle)) {
        hold();
    }
    ~HeldBonds() { letGo(); }
    HeldBonds(const HeldBonds&) = delete;
    HeldBonds& operator=(const HeldBonds&) = delete;

    explicit operator bool() const { return any_; }

    void hold() {
        if (!any_ || held_) return;
        laws_ = state_.laws;
        std::transform(laws_.begin(), laws_.end(), state_.laws.begin(), contact::held);
        held_ = true;
    }
    void letGo() {
        if (!held_) return;
        state_.laws.swap(laws_);
        held_ = false;
    }

 private:
    State& state_;
    std::vector<contact::JointLaw> laws_{};
    bool any_, held_ = false;
};

void takeSteps(State& state, QuasiStaticWork& work, Probe& probe, const SetLoad& set_load = {}) {
    advance(state, {work.time_step, work.parallel}, kStepsPerSample, set_load);
    probe.steps += kStepsPerSample;
    work.steps += kStepsPerSample;
    const bool may_wait = work.steps - work.searched_at < work.pair_waits;
    if (!refreshInterfaces(state, work.parallel, kStepsPerSample * work.time_step, work.control->stop, {},
                           may_wait))
        return;
    work.searched_at = work.steps;
    fitToContacts(state, work);
}

/// Where a probe begins.
struct Start {
    PositionArray position;
    QuaternionArray orientation;
    double reach;  ///< of the bolts [m]
};

/// The load stays as it is.
void watchUntilDecided(State& state, QuasiStaticWork& work, const Start& start, Probe& probe) {
    Watch watch(state, work);
    DragTuner tuner(state);
    const auto steps_per_tuning =
        std::max<std::int64_t>(20, std::llround(0.25 * work.slow_period / work.time_step));
    std::int64_t next_tuning = probe.steps + steps_per_tuning;
    bool decided = false;
    while (!decided && !interrupted(work) && probe.steps < work.settings.max_steps_per_probe) {
        takeSteps(state, work, probe);
        decided = watch.look(probe);
        if (!decided && probe.steps % kStepsPerGlance == 0 &&
            hasGone(state, start.position, start.orientation, start.reach)) {
            probe.verdict = Verdict::failing;
            probe.reason = describe("a block has left its place: out-of-balance force", probe.out_of_balance,
                                    probe.steps);
            decided = true;
        }
        if (probe.steps < next_tuning) continue;
        tuner.tune(state, work);
        next_tuning = probe.steps + steps_per_tuning;
    }
    if (!decided) {
        probe.reason = interrupted(work) ? "interrupted"
                                         : describe("still moving with", probe.out_of_balance, probe.steps);
    }
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
    // A first guess that the gravity loading corrects: an assembly n blocks across has a slowest period of about 2 n
    // times its fastest.
    const double across = std::cbrt(static_cast<double>(state.blocks.size()));
    work.slow_period = 4.0 * across * 2.0 * M_PI / std::sqrt(bound);
    work.slow_period_limit = kSlowPeriodGrowth * work.slow_period;
    work.out_of_balance_limit = std::max(kShareOfTolerance * load_tolerance, roundingLevel(state, bounds));
    if (work.out_of_balance_limit > load_tolerance)
        state.warnings.push_back(
            "stiffness and coordinates, or the blocks that others lie on, are so large that rounding leaves "
            "the out-of-balance force at " +
            std::to_string(work.out_of_balance_limit) +
            " of the weight: the answer is no more accurate than that");
    work.release = std::min(1.0, work.time_step / (2.0 * work.slow_period));
    const auto free = std::count(state.blocks.motion.begin(), state.blocks.motion.end(), Motion::free);
    work.pair_waits = free / kBlocksPerWait;
    takeBack(state, work);
    return work;
}

QuasiStaticWork patient(const QuasiStaticWork& work, double drag_share, double watch_periods) {
    QuasiStaticWork patient = work;
    patient.settings.watch_periods = std::max(watch_periods, work.settings.watch_periods);
    patient.settings.drag_ratio *= drag_share;
    patient.steps = patient.searched_at = 0;
    return patient;
}

double largestMotion(const State& state, const PositionArray& position, const QuaternionArray& orientation) {
    double largest = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] == Motion::free)
            largest = std::max(largest, wayFrom(position, orientation, state, b));
    }
    return largest;
}

void learnPeriod(QuasiStaticWork& work, const State& before, const State& now) {
    const double period = observedPeriod(now, before.blocks.position, externalLoad(before));
    work.slow_period = std::clamp(period, work.slow_period, work.slow_period_limit);
}

void takeBack(State& state, const QuasiStaticWork& work) {
    setAtRest(state.blocks);
    setInertia(state, work.inertia_scale);
    state.damping = work.damping;
    state.release = work.release;
}

Probe bringOn(State& state, QuasiStaticWork& work, const Ramp& ramp) {
    const Stopwatch stepping;
    Probe probe;
    DragTuner::setDrag(state, work, work.slow_period);
    const Start start{state.blocks.position, state.blocks.orientation, tieReach(state)};
    const ExternalLoad before = externalLoad(state);
    const auto ramp_samples = std::max<std::int64_t>(
        2, std::llround(work.settings.ramp_periods * work.slow_period / (kStepsPerSample * work.time_step)));
    const auto ramp_steps = static_cast<double>(ramp_samples * kStepsPerSample);
    HeldBonds bonds(state);
    const SetLoad set_load = [&](int k) {
        bonds.letGo();
        ramp(state, static_cast<double>(probe.steps + k + 1) / ramp_steps);
        bonds.hold();
    };
    for (std::int64_t sample = 0; sample < ramp_samples && !interrupted(work); ++sample)
        takeSteps(state, work, probe, set_load);
    watchUntilDecided(state, work, start, probe);
    if (bonds && probe.verdict == Verdict::stable) {
        bonds.letGo();
        probe.verdict = Verdict::undecided;
        watchUntilDecided(state, work, start, probe);
    }
    probe.displacement = largestMotion(state, start.position, start.orientation);
    if (probe.verdict == Verdict::stable) {
        setAtRest(state.blocks);
        const double period = observedPeriod(state, start.position, before);
        work.slow_period = std::clamp(period, work.slow_period, work.slow_period_limit);
    }
    probe.time.stepping = stepping.seconds();
    return probe;
}

Probe findRest(State& state, QuasiStaticWork& work, std::int64_t most_factors) {
    const Stopwatch solving;
    equilibrium::Options options{.limit = work.out_of_balance_limit,
                                 .most_factors = most_factors,
                                 .leaves_few = work.leaves_few,
                                 .parallel = work.parallel,
                                 .stop = work.control->stop};
    HeldBonds bonds(state);
    equilibrium::Equilibrium found = equilibrium::findEquilibrium(state, options);
    if (bonds && found.verdict == Verdict::stable) {
        bonds.letGo();
        options.most_factors -= found.factors;
        const equilibrium::Equilibrium whole =
            std::exchange(found, equilibrium::findEquilibrium(state, options));
        found.factors += whole.factors;
        found.displacement = std::max(found.displacement, whole.displacement);
    }
    work.factors += found.factors;
    work.leaving = found.leaving;
    fitToContacts(state, work);
    Probe probe{.verdict = found.verdict,
                .factors = found.factors,
                .out_of_balance = found.out_of_balance,
                .displacement = found.displacement,
                .time = {.solving = solving.seconds()},
                .reason = {}};
    char text[160];
    const char* what = found.verdict == Verdict::stable    ? "in equilibrium: out-of-balance force"
                       : found.verdict == Verdict::failing ? "leaves its place with"
                                                           : "no equilibrium found, at";
    std::snprintf(text, sizeof text, "%s %.2e of the weight after %lld factorisations", what,
                  found.out_of_balance, static_cast<long long>(found.factors));
    probe.reason = interrupted(work) ? "interrupted" : text;
    return probe;
}

Probe findRestOfFirstOrder(const State& stood, State& state, QuasiStaticWork& work,
                           std::int64_t most_factors) {
    const Stopwatch solving;
    if (equilibrium::FirstOrderGaps(stood, state).share(state) < work.out_of_balance_limit)
        return {.verdict = Verdict::stable, .reason = {}};
    const equilibrium::Equilibrium found =
        equilibrium::findEquilibrium(state, {.limit = work.out_of_balance_limit,
                                             .most_factors = most_factors,
                                             .leaves_few = work.leaves_few,
                                             .parallel = work.parallel,
                                             .stop = work.control->stop,
                                             .stood = &stood});
    work.factors += found.factors;
    return {.verdict = found.verdict,
            .factors = found.factors,
            .out_of_balance = found.out_of_balance,
            .displacement = found.displacement,
            .time = {.solving = solving.seconds()},
            .reason = {}};
}

}  // namespace talus::analysis
