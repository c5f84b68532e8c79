#pragma once
// Makes the mesh of a joint network finer where boundaries end inside a polygon. The longest side of a triangle
// is halved, first in neighbours whose own is longer: no node comes to lie on a side, and no angle falls below
// half of the least one (Rivara 1984, Int. J. Numer. Methods Eng. 20, 745-756).
//
// Writes: nodes, triangles, patch_of

#include <span>
#include <vector>

#include "flow/footprints.h"

namespace talus::flow {

/// Divides triangles until none is too large, then sides at the outlines that cross them.
/// \return of each patch, whether triangles were divided
std::vector<char> grade(Network& network, std::span<const Footprint> footprints);

}  // namespace talus::flow
