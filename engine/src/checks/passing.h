#pragma once
// What users should know of blocks that may pass through each other.

#include "state/arrays.h"

namespace talus::checks {

/// Warns of every pair of blocks, once, that overlap by more than half of the thinner one's thickness
/// along the contact's normal: what is pressed deeper than that may come out of the far side. For
/// histories, at each look at contacts and before they are found anew: a block that passes is then seen
/// in the contact it came by.
/// Reads:  poses, velocities, interfaces
/// Writes: warnings
/// \param ahead  time since the last look [s]
void warnOfPassing(State& state, double ahead);

}  // namespace talus::checks
