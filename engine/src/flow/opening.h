#pragma once
// What joints have opened since the model was built.
//
// The displacement of block b relative to a, along the joint's normal on a: u = n . (u_b(x) - u_a(x)). The
// walls are planes, so a slide along the joint does not change it. Closed joints have a u below zero by their
// elastic closure. Dilation is part of it.
//
// Reads: poses, initial poses

#include <cstddef>
#include <vector>

#include "flow/network.h"

namespace talus::flow {

inline constexpr std::size_t kPlaces = 4;  ///< of a triangle: its centroid, then its corners

/// At the places of each triangle, triangle by triangle; closing is negative [m].
std::vector<double> openings(const State& state, const Network& network);

}  // namespace talus::flow
