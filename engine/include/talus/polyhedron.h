#pragma once
// Convex polyhedra: the shape of every block.

#include <Eigen/Core>
#include <Eigen/Geometry>  // cross products
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "talus/result.h"

namespace talus {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Which vertices bound each face. Copies share one list, since blocks of one shape are many and their lists equal.
/// A list does not change; a shape with other faces gets another one.
class FaceList {
 public:
    using Outline = std::vector<std::int32_t>;  ///< vertex indices

    FaceList() = default;
    FaceList(std::vector<Outline> faces) : faces_(std::make_shared<std::vector<Outline>>(std::move(faces))) {}
    FaceList(std::initializer_list<Outline> faces) : FaceList(std::vector<Outline>(faces)) {}

    std::size_t size() const { return list().size(); }
    bool empty() const { return list().empty(); }
    const Outline& operator[](std::size_t face) const { return list()[face]; }
    const Outline* begin() const { return list().data(); }
    const Outline* end() const { return list().data() + list().size(); }
    const Outline* data() const { return list().data(); }

    friend bool operator==(const FaceList& a, const FaceList& b) { return a.list() == b.list(); }

 private:
    const std::vector<Outline>& list() const {
        static const std::vector<Outline> kNone;
        return faces_ ? *faces_ : kNone;
    }

    std::shared_ptr<const std::vector<Outline>> faces_;
};

/// A convex polyhedron. Faces are planar convex polygons (coplanar triangles of a hull are merged), their vertices
/// listed counter-clockwise seen from outside. Lengths in m.
struct Polyhedron {
    std::vector<Vec3> vertices;
    FaceList faces;

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

/// How thick it is: the smallest of its extents along its face normals [m].
double smallestExtent(const Polyhedron& shape);

}  // namespace talus
