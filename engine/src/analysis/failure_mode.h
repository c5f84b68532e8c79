#pragma once
// How an assembly fails: a short continuation with true inertia and without local damping, then each block's motion
// read as sliding or toppling.

#include <string>
#include <vector>

#include "state/arrays.h"
#include "talus/analysis.h"

namespace talus::analysis {

struct Failure {
    FailureMode mode = FailureMode::none;
    std::vector<std::string> moving_blocks;  ///< sorted
    std::vector<BlockMotion> motions;        ///< one per free block
    double seconds = 0;                      ///< simulated
    double time_step = 0;                    ///< [s]
    std::int64_t steps = 0;
    double motion = 0;  ///< of the farthest-moved block [m]
};

/// Lets a failing state go on from rest until some block has moved by `target` [m]. The state is advanced.
Failure continueFailure(State& state, double target, const Control& control, bool parallel);

}  // namespace talus::analysis
