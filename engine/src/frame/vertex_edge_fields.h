#pragma once
// Places for vertices and edges (contacts/vertex_edge.h) in a full frame. A place is an interface whose patch
// has one corner; four belong to a pair of blocks. Its contact point lies at the patch's origin, so the
// slopes of its reference gap have no meaning, and the format keeps there what the pair remembers: in the
// first place how far the two may go before they are looked at again, in the second whether their faces are
// apart.

#include "state/arrays.h"
#include "talus/frame.h"

namespace talus {

/// The reference gap as a frame has it: gap [m] and slopes.
Vec3 storedReferenceGap(const Interfaces& interfaces, std::size_t interface);

/// Kinds of all interfaces, and what pairs remember, out of reference gaps as a frame has them, which become
/// those of the law.
/// \pre groups and frames are there, placesFit
void restorePlaces(Interfaces& interfaces);

/// Whether the one-corner patches of a frame come in fours of one pair of blocks.
bool placesFit(const FrameInterfaces& frame);

}  // namespace talus
