#pragma once
// A mesh that is finer towards the corners of drains inside joints.
//
// Flow converges on a drain: the head falls with the logarithm of the distance, and about a corner of its
// outline as distance^(2/3). A triangle is divided while its longest side is longer than a share of its
// distance from the nearest corner. Sides are halved at their middle, in all triangles that meet there: the
// longest of each first (Rivara 1984, International Journal for Numerical Methods in Engineering 20, 745). No
// angle becomes less than half of the smallest before.

#include <span>

#include "flow/network.h"
#include "flow/pieces.h"

namespace talus::flow {

/// Triangles of a patch follow each other afterwards, as before.
void grade(Network& network, std::span<const OutlineCorner> corners);

}  // namespace talus::flow
