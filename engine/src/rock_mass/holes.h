#pragma once
// Holes in surfaces: their outlines, and triangles that close them.

#include <array>
#include <vector>

#include "talus/mend_surface.h"

namespace talus::rock_mass {

/// Corners of a closed run of open edges, in the sense of the triangles beside it.
using Outline = std::vector<std::int32_t>;

/// All of them; where several meet in a corner, each comes back to itself there.
std::vector<Outline> openOutlines(const TriangleSurface& surface);

/// Its area vector by Newell's formula, on the side of the triangles beside it [m^2].
Vec3 areaVectorOf(const Outline& outline, const TriangleSurface& surface);

SurfaceHole holeOf(const Outline& outline, const TriangleSurface& surface);

/// Triangles between its corners that face as those beside it. Nothing when the outline crosses itself, seen
/// along areaVectorOf.
std::vector<std::array<std::int32_t, 3>> lidOf(const Outline& outline, const TriangleSurface& surface);

}  // namespace talus::rock_mass
