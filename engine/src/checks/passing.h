#pragma once
// Warnings of blocks that may pass through each other.

#include "state/arrays.h"

namespace talus::checks {

/// Warns once of every pair of blocks whose overlap exceeds half of the thinner one's thickness along the
/// contact's normal. A deeper block may leave by the far side. For histories, at each look at contacts before
/// they are searched again, so that a passing block is found in its own contact.
/// Reads:  poses, velocities, interfaces
/// Writes: warnings
/// \param ahead  time since the last look [s]
void warnOfPassing(State& state, double ahead);

}  // namespace talus::checks
