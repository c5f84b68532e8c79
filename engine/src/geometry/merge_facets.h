#pragma once
// From the triangles of a convex hull to the polygons of a polyhedron.

#include <array>
#include <cstdint>
#include <vector>

#include "talus/polyhedron.h"

namespace talus {

using Triangle = std::array<std::int32_t, 3>;  ///< point indices, counter-clockwise seen from outside
using Outline = std::vector<std::int32_t>;     ///< likewise

/// Merges neighbouring triangles that lie in one plane within `flatness` (same unit as the points) into
/// convex polygons without collinear vertices. Where the merged faces would not be convex, or not close, the
/// flatness is lowered until they do; the triangles themselves are the last resort.
/// \pre the triangles form a closed convex surface
std::vector<Outline> mergeFacets(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                                 double flatness);

}  // namespace talus
