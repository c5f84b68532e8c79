#pragma once
// How an assembly fails: each block's motion as sliding or toppling, from the last equilibrium to the failing
// state.

#include <string>
#include <vector>

#include "state/arrays.h"
#include "talus/analysis.h"

namespace talus::failure {

struct Failure {
    FailureMode mode = FailureMode::none;
    std::vector<std::string> moving_blocks{};  ///< sorted
    std::vector<BlockMotion> motions{};        ///< one per free block
};

/// \param position,orientation  in the last equilibrium
/// \param deflection  elastic displacement of the blocks [m]
Failure describeFailure(const PositionArray& position, const QuaternionArray& orientation, const State& to,
                        double deflection);

/// The square of the highest angular frequency of a continued failure [1/s^2]. Faster blocks get more
/// inertia: small ones, which would make the time step a hundred times shorter. The addition is a small share
/// of the moving mass, and of all free mass.
/// \param moving  per block
double playedFrequency(const State& state, const std::vector<char>& moving, bool parallel);

/// Adds inertia to blocks faster than that until they are as slow. Weight stays. Writes: inertia
void slowDownTo(State& state, double frequency, bool parallel);

/// Dashpots against contact chatter: half the critical damping of the fastest mode [s].
double rattleDamping(double frequency);

}  // namespace talus::failure
