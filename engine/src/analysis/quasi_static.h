#pragma once
// Quasi-static work: a load is changed slowly, then the assembly is watched until it is at rest or is seen to fail.
//
// The path to equilibrium is that of a system with scaled inertia (never scaled weight), drag near the critical one of
// its slowest mode and a little of Cundall's local damping. Where it comes to rest forces balance, so none of these
// matters to the answer. (Local damping alone converges several times more slowly: its sign follows the fastest modes,
// and the slow ones go undamped.)

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "analysis/watch.h"
#include "state/arrays.h"
#include "talus/analysis.h"

namespace talus::analysis {

/// Everything quasi-static work needs beside the state.
struct QuasiStaticWork {
    QuasiStatic settings;
    const Control* control = nullptr;
    bool parallel = false;
    double time_step = 0;             ///< of the scaled system [s]
    double frequency_bound = 0;       ///< square of the angular frequency the inertia is scaled to [1/s^2]
    double slow_period = 0;           ///< estimate of its slowest period [s]
    double slow_period_limit = 0;     ///< the estimate grows with what is observed, at most to this [s]
    double out_of_balance_limit = 0;  ///< at rest below this share of the weight
    std::int64_t steps = 0;           ///< taken so far
    std::int64_t searched_at = 0;     ///< the last search for contacts, in these steps
    std::int64_t pair_waits = 0;      ///< steps for which a pair may wait that alone wants a search
    std::int64_t factors = 0;         ///< factorisations, likewise
    double leaving = 0;  ///< in the last solve for one, of what neighbours part by that leave their place
    bool leaves_few = false;  ///< of the implicit solve (equilibrium::Options)
    bool inertia_scaled = false;
    std::vector<double> inertia_scale{};  ///< per block, over the true inertia
    Damping damping{};
    double release = 1;  ///< share of a broken bond released per step
};

/// Steps and factorisations in one number (Control::most_work): of 90 to 3,000 blocks one of these takes as long as 8 to 30 steps.
inline std::int64_t workOf(std::int64_t steps, std::int64_t factors) {
    constexpr std::int64_t kStepsInFactor = 10;
    return steps + kStepsInFactor * factors;
}

/// Sets damping, inertia and time step of quasi-static work on a state, and a first estimate of the slowest period.
QuasiStaticWork prepare(State& state, const QuasiStatic& settings, const Control& control,
                        double load_tolerance, bool parallel);

/// Gives a state that has gone on with true inertia back to quasi-static work, at rest.
void takeBack(State& state, const QuasiStaticWork& work);

/// The same work with a share of the drag and windows of so many slowest periods: what looks like failure to the hasty,
/// because a mode is many times slower than the slowest known one, is seen to slow down. Its steps are its own.
QuasiStaticWork patient(const QuasiStaticWork& work, double drag_share, double watch_periods);

/// Learns the slowest period from what the loads have moved between two states at rest.
void learnPeriod(QuasiStaticWork& work, const State& before, const State& now);

/// Changes a load: called with 0 < share <= 1 of the way.
using Ramp = std::function<void(State&, double share)>;

/// Brings the load on over some slowest periods, then decides:
///  - stable: the out-of-balance force stays below its limit for one slowest period;
///  - failing: motion without resistance: the out-of-balance force stays on a plateau, or grows, while the blocks do
///    not slow down. Either flat to a few per cent over a window of some slowest periods (an oscillation of up to
///    thirty times that period would not look so), or level from window to window under some noise, or noisy but no
///    lower over a span of several windows than before.
///    Or a block has gone a tenth of its own size;
///  - undecided: neither within the allowed steps, or interrupted.
/// At rest the velocities are set to zero.
/// \param left_open  takes what is known of a motion that is left undecided
Probe bringOn(State& state, QuasiStaticWork& work, const Ramp& ramp,
              std::optional<Watched>* left_open = nullptr);

/// Goes on with what was left undecided, in the state in which it was, with as many more steps. What has been seen of the motion counts.
Probe goOn(State& state, QuasiStaticWork& work, Watched& watched);

/// The same question answered by the implicit solve (equilibrium/find_equilibrium.h), from a state at rest whose load
/// has been changed: a few hundred factorisations at most, whatever the slowest period. What it finds at rest is so
/// by the engine's own forces; that it finds none, within its budget, is no failure.
Probe findRest(State& state, QuasiStaticWork& work, std::int64_t most_factors);

/// Whether what has come to rest rests without what its blocks close of the joints by turning together, too
/// (equilibrium/first_order_gaps.h). Failing: blocks are jammed there, and the state is one into which they move when they are not.
/// \param stood  where it last stood
Probe findRestOfFirstOrder(const State& stood, State& state, QuasiStaticWork& work,
                           std::int64_t most_factors);

}  // namespace talus::analysis
