#pragma once
// A contact found already overlapping, without work by its blocks, counts its gap from that depth: its
// reference gap lies below the faces (contacts/vertex_edge.h, contacts/carry_over.h). It recovers the overlap
// from the kinetic energy of its blocks.

#include "state/arrays.h"

namespace talus {

/// Each such contact may take a small share of the kinetic energy of the relative motion at its deepest
/// contact point, by opposite impulses there. It raises its reference gap by at most what that energy allows,
/// and takes what its springs gain. Momentum, angular momentum and energy are conserved. An overlap within
/// kClosedGap of the smaller block's size is left alone: faces that touch at the start have it. One after the
/// other in the order of the interfaces, since neighbours share a block.
/// Reads:  poses, interfaces' frames, laws
/// Writes: interfaces' reference gaps, velocity, angular_momentum
/// \return whether any contact has recovered something
bool recoverGaps(State& state);

/// Whether there was a search after the first: before it no pair of faces has a gap to recover.
bool searchedAgain(const State& state);

}  // namespace talus
