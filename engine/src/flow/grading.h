#pragma once
// Makes the mesh of a joint network finer where boundaries end inside a polygon. The longest side of a triangle
// is divided, first in neighbours whose own is longer, so that no node comes to lie on a side. Halved, no angle
// falls below half of the least one (Rivara 1984, Int. J. Numer. Methods Eng. 20, 745-756).
//
// Writes: nodes, triangles, patch_of

#include <span>
#include <vector>

#include "flow/footprints.h"

namespace talus::flow {

/// Divides triangles until no side is longer than `mostSide`. A side that the outline of a boundary crosses
/// near its middle is divided at the crossing, so that nodes come to lie on the outline.
/// \return of each patch, whether triangles were divided
std::vector<char> grade(Network& network, std::span<const Footprint> footprints);

}  // namespace talus::flow
