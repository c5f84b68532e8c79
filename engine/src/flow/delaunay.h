#pragma once
// Turns the sides inside polygons of the network so that their triangles are Delaunay's (Lawson 1977,
// Mathematical Software III, 161-194). No conductance of such a side is negative then. With many negative ones
// water could seem to flow into an outlet that drains. Sides on the outline of a polygon stay, and so do those
// on the outline of a boundary, between two nodes of it.
//
// Writes: triangles

#include <span>
#include <vector>

#include "flow/footprints.h"

namespace talus::flow {

/// \param patches  of each patch, whether its sides are turned
void makeDelaunay(Network& network, const std::vector<char>& patches, std::span<const Footprint> footprints);

}  // namespace talus::flow
