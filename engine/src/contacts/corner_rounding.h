#pragma once
// Corners at kinks, where the bed of a slab ends and that of another block begins. With plane faces the slab
// would have to ride up on a perfectly sharp corner at its first displacement. Rock corners are not that
// sharp, so such corners count as rounded. Where two corners meet, the direction of their contact is
// undetermined until they have moved a little.

#include <cstddef>

#include "contacts/vertex_edge_points.h"
#include "state/arrays.h"

namespace talus {

/// Whether a new point is left out because a corner there is rounded and it is not deeper than that.
/// With Springs::keep_energy corners are rounded less.
/// \param interface any place of the pair to which the point belongs
/// \param size      the smaller block's [m]
/// Reads: poses, shapes, interfaces, incidence
bool isRoundedOff(const State& state, std::size_t interface, const VertexEdgePoint& point, double size);

}  // namespace talus
