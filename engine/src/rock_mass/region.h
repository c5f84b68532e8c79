#pragma once
// The region as convex cells.
//
// First the planes of its convex hull cut a box about it: a convex region is then complete. Otherwise the
// plane of any triangle that reaches into a cell cuts that cell, until none does. Cells that a vertical ray
// finds inside the surface are kept. Cells cut apart inside the region are pieces of one solid.

#include <atomic>
#include <vector>

#include "rock_mass/cell.h"
#include "talus/result.h"
#include "talus/rock_mass.h"

namespace talus::rock_mass {

/// Coordinates of STL files have seven digits: triangles within this share of the extent of one plane are one
/// face.
inline constexpr double kFlatness = 1e-6;

/// The region's cells; appends the planes of its surface. \pre a checked surface
/// Errors: a surface that crosses itself (the cells do not add up to its volume); `stop`.
Result<std::vector<Cell>> decompose(const TriangleSurface& surface, std::vector<Plane>& planes,
                                    VertexTable& vertices, const std::atomic<bool>* stop = nullptr);

}  // namespace talus::rock_mass
