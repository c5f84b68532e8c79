#pragma once
// The region as convex cells.
//
// Planes of the surface that the whole surface lies behind (its convex hull's) cut a box about it first: a
// convex region is done then. Elsewhere a cell that a triangle reaches into is cut by the plane of that
// triangle, until none does; what a vertical ray finds inside the surface is kept. Cells cut apart inside the
// region belong together, they are pieces of one solid.

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
