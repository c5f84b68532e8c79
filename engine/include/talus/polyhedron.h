#pragma once
// Convex polyhedra: the shape of every block.

#include <Eigen/Core>
#include <Eigen/Geometry>  // cross products
#include <cstdint>
#include <vector>

#include "talus/result.h"

namespace talus {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// A convex polyhedron. Faces are planar convex polygons (coplanar triangles of a hull are merged), their vertices
/// listed counter-clockwise seen from outside. Lengths in m.
struct Polyhedron {
    std::vector<Vec3> vertices;
    std::vector<std::vector<std::int32_t>> faces;  ///< vertex indices per face

    /// Outward unit normal (Newell's formula) and centroid of the face's area.
    Vec3 faceNormal(std::size_t face) const;
    Vec3 faceCentroid(std::size_t face) const;
    double faceArea(std::size_t face) const;  ///< [m^2]
};

/// Volume integrals for unit density, exact for polyhedra (signed tetrahedra; Tonon 2004).
struct MassProperties {
    double volume = 0;             ///< [m^3]
    Vec3 centroid = Vec3::Zero();  ///< [m]
    Mat3 inertia = Mat3::Zero();   ///< about the centroid, per unit density [m^5]
};

/// Axis-aligned box; `min` must be below `max` in each coordinate (else an error names the axis).
Result<Polyhedron> makeBox(const Vec3& min, const Vec3& max);

/// Convex hull of at least four points that do not lie in one plane; points inside the hull are dropped, coplanar
/// facets merged. Errors: too few points, a flat or degenerate set, non-finite coordinates.
Result<Polyhedron> convexHull(const std::vector<Vec3>& points);

MassProperties massProperties(const Polyhedron& shape);

}  // namespace talus
