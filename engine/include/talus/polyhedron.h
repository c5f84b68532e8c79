#pragma once
// Polyhedra: the shape of every block, convex or made of convex parts.

#include <Eigen/Core>
#include <Eigen/Geometry>  // cross products
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "talus/result.h"

namespace talus {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

struct ConvexPart;

/// How much of a face lies on faces of other parts of the same shape. A wholly covered face is inside: no
/// surface.
enum class Cover : std::uint8_t { none, partly, wholly };

/// Vertices of each face, and faces of each convex part. Copies share one list, since many blocks have the
/// same shape. A list never changes; a shape with other faces gets another one.
class FaceList {
 public:
    using Outline = std::vector<std::int32_t>;  ///< vertex indices

    FaceList() = default;
    FaceList(std::vector<Outline> outlines);
    FaceList(std::initializer_list<Outline> outlines) : FaceList(std::vector<Outline>(outlines)) {}
    /// \param covers one per face
    FaceList(std::vector<Outline> outlines, std::vector<ConvexPart> parts, std::vector<Cover> covers);

    std::size_t size() const { return outlines().size(); }
    bool empty() const { return outlines().empty(); }
    const Outline& operator[](std::size_t face) const { return outlines()[face]; }
    const Outline* begin() const { return outlines().data(); }
    const Outline* end() const { return outlines().data() + outlines().size(); }
    const Outline* data() const { return outlines().data(); }

    /// Convex parts, their vertices and faces one after the other; none where the whole is convex.
    const std::vector<ConvexPart>& parts() const { return lists().parts; }
    /// One per face; none where the whole is convex.
    const std::vector<Cover>& covers() const { return lists().covers; }

    friend bool operator==(const FaceList& a, const FaceList& b) { return a.outlines() == b.outlines(); }

 private:
    struct Lists {
        std::vector<Outline> outlines;
        std::vector<ConvexPart> parts;
        std::vector<Cover> covers;
    };
    const Lists& lists() const;
    const std::vector<Outline>& outlines() const { return lists().outlines; }

    std::shared_ptr<const Lists> lists_;
};

/// A range of a shape's vertices and one of its faces.
struct ConvexPart {
    std::int32_t first_vertex = 0, vertices = 0;
    std::int32_t first_face = 0;
    FaceList faces;                      ///< vertices counted from the part's first
    std::vector<std::int32_t> beside{};  ///< parts it touches, if only in a point; ascending
};

/// A polyhedron: convex, or convex parts that share faces or pieces of faces and nothing else. Faces are
/// planar convex polygons (coplanar triangles of a hull are merged), their vertices listed counter-clockwise
/// seen from outside their part. Lengths in m.
struct Polyhedron {
    std::vector<Vec3> vertices;
    FaceList faces;

    std::size_t partCount() const { return faces.parts().empty() ? 1 : faces.parts().size(); }
    /// Whether the face is inside: no surface of the whole.
    bool isInner(std::size_t face) const {
        return !faces.covers().empty() && faces.covers()[face] == Cover::wholly;
    }

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

/// Convex hull of at least four points that do not lie in one plane; points inside the hull are dropped,
/// coplanar facets merged. Errors: too few points, a flat or degenerate set, non-finite coordinates.
Result<Polyhedron> convexHull(const std::vector<Vec3>& points);

/// One shape of convex parts, in the order given; of one part it is that part. Parts may share faces, pieces
/// of faces, edges and vertices. Errors ("[i]" is the part): none given, a part that is of several itself or
/// overlaps another, one that shares no face with the others.
Result<Polyhedron> joinParts(const std::vector<Polyhedron>& parts);

/// The convex parts of a shape, each by itself.
std::vector<Polyhedron> partsOf(const Polyhedron& shape);

/// Whether a point is in the shape or on its surface, within `tolerance` [m].
bool contains(const Polyhedron& shape, const Vec3& point, double tolerance = 0);

/// The side of a shape towards a direction: the face whose normal is nearest to it (the first of several),
/// with faces of other parts in its plane.
std::vector<std::int32_t> sideTowards(const Polyhedron& shape, const Vec3& direction);

/// Exact also where the shape is of several parts: their inner faces cancel.
MassProperties massProperties(const Polyhedron& shape);

/// How thick it is: the smallest of its extents along the normals of its surface [m]. With several parts at
/// most six times volume over surface, which is a cube's side: an angle section is as thin as its plates.
double smallestExtent(const Polyhedron& shape);

}  // namespace talus
