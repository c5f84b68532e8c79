#pragma once
// What is wrong with surfaces, open or closed.

#include <string>
#include <vector>

#include "talus/surface.h"

namespace talus::rock_mass {

inline constexpr std::size_t kMostFaults = 20;

std::string triangleField(std::size_t triangle);

inline const Vec3& cornerOf(const TriangleSurface& surface, std::size_t triangle, std::size_t corner) {
    return surface.vertices[static_cast<std::size_t>(surface.triangles[triangle][corner])];
}

/// Twice its area along its normal [m^2].
inline Vec3 areaVector(const TriangleSurface& surface, std::size_t triangle) {
    const Vec3& a = cornerOf(surface, triangle, 0);
    return (cornerOf(surface, triangle, 1) - a).cross(cornerOf(surface, triangle, 2) - a);
}

/// A directed edge of a triangle that has no twin.
struct OpenEdge {
    std::int32_t from = 0, to = 0;
    std::size_t triangle = 0;
};

/// Of all triangles, in their order. \pre no edge is run through twice the same way
std::vector<OpenEdge> openEdges(const TriangleSurface& surface);

/// No triangles, indices and coordinates, triangles without area, non-manifold edges, neighbours that face
/// opposite ways; open edges, unless they are allowed.
std::vector<Error> facetErrors(const TriangleSurface& surface, bool may_be_open);

/// The places where a surface crosses itself, or folds back onto itself. \pre no facetErrors
std::vector<Error> crossingErrors(const TriangleSurface& surface);

}  // namespace talus::rock_mass
