#pragma once
// A contact that came about with an overlap which its blocks have not worked for counts its gap from where it
// was found (contacts/vertex_edge.h, contacts/carry_over.h): its reference gap is below where the faces are.
// It recovers that as its blocks pay for it.

#include "state/arrays.h"

namespace talus {

/// Each such contact may take a small share of the kinetic energy with which its two blocks move against each
/// other at its deepest contact point, by an impulse and its opposite there, and raises its reference gap by
/// no more than that energy presses its springs together; it takes what they then do hold more. Momentum and
/// angular momentum stay as they are, and so does the energy. An
/// overlap within kClosedGap of the smaller block's size is left alone: faces that touch at the start have
/// it. One after the other in the order of the interfaces, since neighbours share a block.
/// Reads:  poses, interfaces' frames, laws
/// Writes: interfaces' reference gaps, velocity, angular_momentum
/// \return whether any contact has recovered something
bool recoverGaps(State& state);

/// Whether there was a search since the first: before it no pair of faces has a gap to recover.
bool searchedAgain(const State& state);

}  // namespace talus
