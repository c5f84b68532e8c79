#pragma once
// Corners at kinks: that of a slab where its bed ends and the next one, another block's, begins. As a body of
// plane faces it would have to ride up with its first move, on a corner as sharp as no rock's is. Such
// corners count as rounded. And where two corners meet, in which direction they hold each other is anybody's
// choice until they have moved a little.

#include <cstddef>

#include "contacts/vertex_edge_points.h"
#include "state/arrays.h"

namespace talus {

/// Whether a new point is left out because a corner there is rounded and it is not deeper than that.
/// With Springs::keep_energy corners are rounded less.
/// \param interface any place of the pair that the point was found for
/// \param size      the smaller block's [m]
/// Reads: poses, shapes, interfaces, incidence
bool isRoundedOff(const State& state, std::size_t interface, const VertexEdgePoint& point, double size);

}  // namespace talus
