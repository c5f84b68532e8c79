#pragma once
// No energy comes of the steps. A spring that closes or opens in the middle of one costs or gives up to
// (omega dt)^2/4 of the energy of the impact, and a pressed one seems to hold as much more or less than the
// blocks have lost: that is what a second-order step is. What is given is taken back between steps, from the
// motion of the blocks that touch.

#include "state/arrays.h"

namespace talus {

/// Kinetic, elastic and gravity energy [J].
double totalEnergy(const State& state, bool parallel);

/// Whether nothing else works on the blocks: no water, nothing driven.
bool isLeftAlone(const State& state);

/// Takes the energy out of the relative motion of the blocks that touch or have touched within the last
/// `since` seconds, in shares of that motion: at most half of it, so that where they hardly move something
/// may be left.
/// \pre forces as they are; nothing is taken for energy <= 0
/// Writes: velocity, angular_momentum, angular_velocity
void takeBack(State& state, double energy, double since, bool parallel);

}  // namespace talus
