#pragma once
// How an assembly fails: a short continuation with true inertia and without local damping, then each block's motion
// read as sliding or toppling.

#include <string>
#include <vector>

#include "state/arrays.h"
#include "talus/analysis.h"

namespace talus::analysis {

/// Share of the stability bound that motion with true inertia takes here: dashpots eat what a long step stirs up.
inline constexpr double kContinuationStepSafety = 0.85;

struct Failure {
    FailureMode mode = FailureMode::none;
    std::vector<std::string> moving_blocks;  ///< sorted
    std::vector<BlockMotion> motions;        ///< one per free block
    double seconds = 0;                      ///< simulated
    double time_step = 0;                    ///< [s]
    std::int64_t steps = 0;
    double motion = 0;       ///< of the farthest-moved block [m]
    bool confirmed = false;  ///< it went several times the deflection at rest
    bool at_rest = false;    ///< and came to rest again
};

/// Lets a failing state go on from rest until it has moved many times `deflection`, the way it has come at rest [m], and
/// it is clear how it moves. The state is advanced.
Failure continueFailure(State& state, double deflection, const Control& control, bool parallel);

}  // namespace talus::analysis
