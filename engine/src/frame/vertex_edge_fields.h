#pragma once
// Places for vertices and edges (contacts/vertex_edge.h) in a full frame. A place is an interface whose patch
// has one corner; four belong to a pair of blocks. Its contact point lies at the patch's origin, so the
// slopes of its reference gap have no meaning. The format keeps the pair's memory there: in the first place
// the displacement until the next look, in the second whether their faces are apart.

#include "state/arrays.h"
#include "talus/frame.h"

namespace talus {

/// The reference gap as a frame has it: gap [m] and slopes.
Vec3 storedReferenceGap(const Interfaces& interfaces, std::size_t interface);

/// Restores the kinds of interfaces and the pairs' memory from a frame's reference gaps, and turns these into
/// the law's.
/// \pre groups and frames are there, placesFit
void restorePlaces(Interfaces& interfaces);

/// Whether the one-corner patches of a frame come in fours of one pair of blocks.
bool placesFit(const FrameInterfaces& frame);

}  // namespace talus
