#pragma once
// Static equilibrium of a state under its loads, found implicitly.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

#include "state/arrays.h"
#include "talus/analysis.h"

namespace talus::equilibrium {

/// Of as many blocks some small ones always stall a step, other ones in each.
inline constexpr std::size_t kBlocksWithCrumbs = 150;

struct Options {
    double limit = 1e-6;                ///< at rest below this out-of-balance force over the weight
    std::int64_t most_factors = 2'000;  ///< factorisations after which it gives up
    /// of the median block size: neighbours that part or slide farther have left their place
    double leaves = 2e-4;
    double release = 0.25;  ///< share of a broken bond released per step
    /// of many blocks: a step need not come to its end for the few that stall it, which go on by themselves after it; else they
    /// have more drag
    bool leaves_few = false;
    bool parallel = false;  ///< the search for contacts; the solve itself is serial
    const std::atomic<bool>* stop = nullptr;
    /// where the assembly last stood: gaps are those of first order (equilibrium/first_order_gaps.h), and no contacts are looked for
    const State* stood = nullptr;
};

/// What was found, and on what it rests.
struct Equilibrium {
    Verdict verdict = Verdict::undecided;
    double out_of_balance = 0;  ///< outOfBalanceRatio of the state, by the exact law
    double displacement = 0;    ///< of the farthest-moved block [m]
    double parted = 0;          ///< largest change of slide or gap at a contact point [m]
    double leaving = 0;         ///< of that, in what neighbours part by that leave their place
    std::int64_t steps = 0;     ///< in pseudo-time
    std::int64_t factors = 0;   ///< factorisations
};

/// Looks for the equilibrium that the state comes to when it is let go, from where it stands, against a drag.
///  - stable: at rest by the exact law, plastic slides committed;
///  - failing: on its way it has left its place: neighbours have parted or slid by more than `leaves`, and twenty times what
///    the deepest joint is pressed together, and it does not slow down; or by a hundredth of the block size. What bolts give before they hold most comes on top. An equilibrium
///    farther on is another one than that of the assembly as it stands: blocks that lean on each other find such, and
///    with inertia may go past it;
///  - undecided: neither within the factorisations allowed, or interrupted; the state is the last one reached.
/// Reads and writes: poses, interfaces, points, forces, water. Velocities are not looked at; \pre they are zero
Equilibrium findEquilibrium(State& state, const Options& options);

}  // namespace talus::equilibrium
