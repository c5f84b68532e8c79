#pragma once
// Makes the mesh of the joint network. Each patch is a fan about its centroid. Corners of other patches on one of
// its edges are nodes of that edge, too. About a boundary that ends inside a patch the mesh is finer
// (flow/grading.h). A plane section is the same mesh, one patch wide: on a rectangle with one head at either end
// linear triangles are exact.
//
// Reads: shapes' initial poses, interfaces of faces as built

#include <span>

#include "flow/network.h"
#include "talus/flow_data.h"

namespace talus::flow {

/// \param refinements  how many times each triangle is divided into four
/// \param boundaries   the mesh is finer where they end inside a patch
Network networkOf(const State& state, int refinements, std::span<const FlowBoundary> boundaries = {});

}  // namespace talus::flow
