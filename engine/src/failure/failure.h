#pragma once
// How an assembly fails: each block's motion, read as sliding or toppling, from where it last stood to where
// it has left its place.

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

/// \param position,orientation  where it stood
/// \param deflection  how far blocks come without failing [m]
Failure describeFailure(const PositionArray& position, const QuaternionArray& orientation, const State& to,
                        double deflection);

/// The square of the angular frequency up to which a failure is played on [1/s^2]. Blocks that are faster get
/// more inertia: small ones, which would make its time step a hundred times shorter. What is added is a small
/// share of the mass that moves, and of all free mass.
/// \param moving  per block
double playedFrequency(const State& state, const std::vector<char>& moving, bool parallel);

/// Gives blocks that are faster than that as much inertia as makes them as slow. Weight stays. Writes:
/// inertia
void slowDownTo(State& state, double frequency, bool parallel);

/// Dashpots that take out the rattle: half the critical damping of the fastest mode [s].
double rattleDamping(double frequency);

}  // namespace talus::failure
