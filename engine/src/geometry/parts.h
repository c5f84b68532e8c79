#pragma once
// Shapes of several convex parts: where these lie on each other, and which of a part's area is surface of the
// whole.

#include <optional>
#include <span>
#include <vector>

#include "geometry/polygon.h"
#include "talus/polyhedron.h"

namespace talus {

/// Touching bodies as one shape: their parts in the order given, each with its neighbours, and each face with
/// its covered share. Parts may also lie apart, or overlap. No shape where no two bodies touch.
std::optional<Polyhedron> unionOf(const std::vector<Polyhedron>& bodies);

/// The part of a face that lies on other parts of its shape, in the plane of its faceFrame.
std::vector<Polygon> coversOf(const Polyhedron& shape, std::size_t face);

/// The face's outline there.
Polygon outlineOf(const Polyhedron& shape, std::size_t face);

/// Which part a face belongs to.
std::size_t partOf(const FaceList& faces, std::size_t face);

/// A face's plane: outward unit normal, and a point of it [m].
struct FacePlane {
    Vec3 normal, at;
};
/// Of all faces of a shape, in its own frame.
std::vector<FacePlane> facePlanes(const Polyhedron& shape);

/// A part of a body in the world: distinguishes real vertices and edges of the body from those where parts
/// meet.
struct PartOfBody {
    const Polyhedron& shape;            ///< of the body, in its own frame
    std::span<const FacePlane> planes;  ///< of the shape's faces
    std::size_t part;
    Mat3 turn;             ///< own frame to the world
    Vec3 position;         ///< of the own origin [m]
    double tolerance = 0;  ///< [m]: what is nearer touches

    /// How much of the part's faces lies on other parts.
    std::span<const Cover> covers() const;

    /// Whether no part around a point reaches farther than the point in a direction. Only then can another
    /// body touch it there along this direction: a union allows only the normals that all its members allow.
    /// Points that are no corner of the part pass, too.
    /// \param slack angle by which a part may reach farther [rad]
    bool isOutermost(const Vec3& point, const Vec3& direction, double slack = 0) const;

    /// Whether that holds anywhere between two points of one of the part's edges; where it may, too.
    bool isOutermostAlong(const Vec3& from, const Vec3& to, const Vec3& direction, double slack) const;

    /// Whether a surface with this normal goes on flat, in another part, from a point on the part's outline.
    bool goesOnFlat(const Vec3& point, const Vec3& outward, const Vec3& normal) const;

    /// Whether a point lies in or on another part.
    bool isInOther(const Vec3& point) const;

 private:
    Vec3 own(const Vec3& point) const { return turn.transpose() * (point - position); }
    std::span<const FacePlane> planesOf(const ConvexPart& other) const {
        return planes.subspan(static_cast<std::size_t>(other.first_face), other.faces.size());
    }
};

}  // namespace talus
