#pragma once
// Coordinates in the plane of a face.

#include <Eigen/Geometry>

#include "geometry/polygon.h"
#include "talus/polyhedron.h"

namespace talus {

/// Right-handed frame of a face: origin at its first vertex, e1 along its first edge, e3 its outward normal.
/// It turns with the block; coordinates in it stay small however far the block is from the model's origin.
struct FaceFrame {
    Vec3 origin = Vec3::Zero();  ///< [m]
    Vec3 e1 = Vec3::UnitX(), e2 = Vec3::UnitY(), e3 = Vec3::UnitZ();

    /// Projection along e3 onto the plane.
    Vec2 toPlane(const Vec3& point) const {
        const Vec3 d = point - origin;
        return {e1.dot(d), e2.dot(d)};
    }
    /// Height above the plane, positive outside the block [m].
    double height(const Vec3& point) const { return e3.dot(point - origin); }
    Vec3 toWorld(const Vec2& point) const { return origin + point.x() * e1 + point.y() * e2; }
};

/// \param first, second  the face's first two vertices
/// \param normal         its outward unit normal
inline FaceFrame faceFrame(const Vec3& first, const Vec3& second, const Vec3& normal) {
    const Vec3 edge = second - first;
    const Vec3 e1 = (edge - normal.dot(edge) * normal).normalized();
    return {first, e1, normal.cross(e1), normal};
}

inline FaceFrame faceFrame(const Polyhedron& shape, std::size_t face) {
    const auto& outline = shape.faces[face];
    return faceFrame(shape.vertices[outline[0]], shape.vertices[outline[1]], shape.faceNormal(face));
}

}  // namespace talus
