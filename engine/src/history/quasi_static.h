#pragma once
// Quasi-static work: a load is changed slowly, then explicit steps continue until the assembly is in
// equilibrium or fails.
//
// The path to equilibrium is that of a system with scaled inertia (never scaled weight), drag near the
// critical one of its slowest mode and a little of Cundall's local damping. In equilibrium forces balance, so
// none of these affects the answer. (Local damping alone converges several times more slowly: its sign
// follows the fastest modes, and the slow ones go undamped.)

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "history/watch.h"
#include "state/arrays.h"
#include "talus/control.h"

namespace talus::history {

/// Its settings; the equilibrium does not depend on them.
struct QuasiStatic {
    double local_damping = 0.3;  ///< Cundall; damps chatter
    double drag_ratio = 0.5;  ///< drag on translation and rotation, over the critical one of the slowest mode
    /// Share of the stability bound. At 0.9 contact points that open and close every other step pump energy:
    /// a dry slope with four points at the corners never reached equilibrium. From 0.7 down it did.
    double step_safety = 0.6;
    double ramp_periods = 2.0;   ///< slowest periods over which a load is changed
    double watch_periods = 1.5;  ///< slowest periods in a window in which a plateau is looked for
    std::int64_t most_steps = 2'000'000;
};

/// Data of quasi-static work beside the state.
struct QuasiStaticWork {
    QuasiStatic settings;
    const Control* control = nullptr;
    bool parallel = false;
    double time_step = 0;             ///< of the scaled system [s]
    double frequency_bound = 0;       ///< square of the angular frequency the inertia is scaled to [1/s^2]
    double slow_period = 0;           ///< estimate of its slowest period [s]
    double slow_period_limit = 0;     ///< the estimate grows with what is observed, at most to this [s]
    double out_of_balance_limit = 0;  ///< in equilibrium below this share of the weight
    std::int64_t steps = 0;           ///< taken so far
    std::int64_t searched_at = 0;     ///< the last search for contacts, in these steps
    std::int64_t pair_waits = 0;      ///< steps for which a single pair that wants a search may wait
    bool inertia_scaled = false;
    std::vector<double> inertia_scale{};  ///< per block, over the true inertia
    Damping damping{};
    double release = 1;  ///< share of a broken bond released per step
};

/// Sets damping, inertia and time step of quasi-static work on a state, and a first estimate of the slowest
/// period.
QuasiStaticWork prepare(State& state, const QuasiStatic& settings, const Control& control,
                        double load_tolerance, bool parallel);

/// Returns a state that has moved with true inertia to quasi-static work, with zero velocities.
void takeBack(State& state, const QuasiStaticWork& work);

/// Changes a load: called with a share of it, 0 < share <= 1.
using Ramp = std::function<void(State&, double share)>;

/// Applies the load over some slowest periods, then decides:
///  - stable: the out-of-balance force stays below its limit for one slowest period;
///  - failing: motion without resistance: the out-of-balance force stays on a plateau, or grows, while the
///    blocks do not slow down. The force is flat to a few per cent over a window of some slowest periods
///    (which excludes oscillations of up to thirty times that period). Or it is level from window to window
///    under some noise, or noisy but no lower over a span of several windows than before. Or a block has
///    moved by a tenth of its own size;
///  - undecided: neither within the allowed steps, or interrupted.
/// At rest the velocities are set to zero.
Settling bringOn(State& state, QuasiStaticWork& work, const Ramp& ramp);

}  // namespace talus::history
