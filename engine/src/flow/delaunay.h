#pragma once
// Turns the sides inside polygons of the network so that their triangles are Delaunay's (Lawson 1977,
// Mathematical Software III, 161-194). No conductance of such a side is negative, so that heads between given
// heads stay between them, and an outlet into which water flows is not one that water should leave.
//
// Writes: triangles

#include <vector>

#include "flow/network.h"

namespace talus::flow {

/// \param patches  of each patch, whether its sides are turned; those on the outline of a patch stay
void makeDelaunay(Network& network, const std::vector<char>& patches);

}  // namespace talus::flow
