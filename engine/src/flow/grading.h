#pragma once
// A mesh that is finer towards the corners of drains inside joints.
//
// Flow converges on a drain: the head falls with the logarithm of the distance, and about a corner of its
// outline as distance^(2/3). A triangle is divided while its longest side is longer than a share of its
// distance from the nearest corner. Sides are halved at their middle, in all triangles that meet there: the
// longest of each first (Rivara 1984, International Journal for Numerical Methods in Engineering 20, 745). No
// angle becomes less than half of the smallest before.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "flow/pieces.h"

namespace talus::flow {

/// Parts of a network.
struct Mesh {
    std::vector<Vec3>& nodes;  ///< [m]
    std::vector<std::array<std::int32_t, 3>>& triangles;
    std::vector<std::int32_t>& patch_of;  ///< of each triangle
};

/// Triangles of a patch follow each other afterwards, as before.
void grade(const Mesh& mesh, std::span<const OutlineCorner> corners);

}  // namespace talus::flow
