#pragma once
// How an assembly fails: a short continuation with true inertia (but for blocks far stiffer than most), mostly without local
// damping, then each block's motion read as sliding or toppling.

#include <functional>
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
    double contact_damping = 0;              ///< of the same motion with every block's true inertia [s]
    std::int64_t steps = 0;
    double motion = 0;                 ///< of the farthest-moved block [m]
    bool confirmed = false;            ///< it went as far as was wanted and gathers speed
    bool at_rest = false;              ///< it came to rest
    bool is_doubted = false;           ///< it was asked for rest
    bool stands = false;               ///< and there is some
    bool is_clean_slide = false;       ///< all that moves slides, about as far, and all else stands
    std::vector<std::size_t> falling;  ///< of a confirmed failure: blocks that go with the farthest one
};

/// What has to be seen before a motion counts as failure, and what may be spent on it.
struct Evidence {
    double deflection = 0;        ///< the way the assembly has come at rest [m]: several times that
    double share = 0;             ///< a block has gone this share of its own size
    std::int64_t most_steps = 0;  ///< then the continuation ends, whatever it has seen
    std::int64_t most_steps_on_its_way =
        0;  ///< but for a motion that goes on and is not yet seen to be one or none
    /// Nothing else says that it fails, so friction must not be let shake it loose: what slides on springs without damping may rock
    /// itself up (engine/README.md), and an assembly that stands creeps downhill then.
    bool alone = false;
    std::int64_t doubted_after = 0;  ///< steps; what they have not borne out is asked for rest, once
    std::function<bool()> rests{};   ///< whether there is some; empty: nobody asks
};

/// Lets a failing state go on from rest with true inertia until the motion is seen to be a failure and it is clear how it
/// moves, the steps are used up, or it is found to stand. The state is advanced.
/// \param moving  blocks that are known to leave: only they and what is near go on, the others are held. Where that does not show the
///                 failure, or what moves touches or has touched one that is held, all go on. Empty: nobody knows
Failure continueFailure(State& state, const Evidence& wanted, const Control& control, bool parallel,
                        const std::vector<std::size_t>& moving = {});

/// How blocks have moved from one state to another: mode, moving blocks and motions, of a failure that is not let go.
Failure describeWay(const State& from, const State& to);

}  // namespace talus::analysis
