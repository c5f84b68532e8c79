#pragma once
// Steps add no energy. A spring that closes or opens in the middle of a step loses or adds up to (omega
// dt)^2/4 of the energy of the impact. A pressed spring holds as much more or less than the blocks have lost,
// by the second-order error of a step. Added energy is removed between steps from the motion of touching
// blocks.

#include "state/arrays.h"

namespace talus {

/// Kinetic, elastic and gravity energy [J].
double totalEnergy(const State& state, bool parallel);

/// Whether nothing else works on the blocks: no water, nothing driven.
bool isLeftAlone(const State& state);

/// Takes the energy out of the relative motion of blocks that touch or have touched within the last `since`
/// seconds, in proportion to that motion. It takes at most half of it, so some may remain where blocks hardly
/// move.
/// \pre forces as they are; nothing is taken for energy <= 0
/// Writes: velocity, angular_momentum, angular_velocity
void takeBack(State& state, double energy, double since, bool parallel);

}  // namespace talus
