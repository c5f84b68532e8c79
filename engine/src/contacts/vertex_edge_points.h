#pragma once
// Where two convex blocks meet otherwise than face to face: a vertex or an edge on a face, or two edges that
// cross.

#include <array>
#include <cstdint>

#include "geometry/world_shape.h"
#include "talus/polyhedron.h"

namespace talus {

/// One such place. The reference plane goes with one of the two blocks; its normal e1 x e2 points to the
/// other.
struct VertexEdgePoint {
    bool second_is_reference = false;
    Vec3 on_reference = Vec3::Zero();  ///< in the reference plane [m]
    Vec3 on_other = Vec3::Zero();      ///< on the other block's vertex or edge [m]
    Vec3 e1 = Vec3::UnitX(), e2 = Vec3::UnitY();
    /// for two edges: of each block's two faces, the pair most opposed to each other
    std::int32_t reference_face = 0;
    std::int32_t other_face = 0;
    double gap = 0;  ///< along the normal, negative for overlap [m]
};

struct VertexEdgePoints {
    static constexpr std::size_t kMost = 4;
    std::size_t count = 0;
    std::array<VertexEdgePoint, kMost> points{};
    bool near = false;  ///< within reach, by vertices and edges or face to face
    /// when near: along the axis they meet along, negative for overlap; otherwise: at least [m]
    double distance = 0;
    Vec3 axis =
        Vec3::Zero();  ///< when near: the axis along which they meet, from the first to the second; zero:
                       ///< none
    std::int32_t first_face = -1,
                 second_face = -1;  ///< the most opposed faces where they meet; -1: none

    const VertexEdgePoint* begin() const { return points.data(); }
    const VertexEdgePoint* end() const { return points.data() + count; }
};

struct VertexEdgeLimits {
    /// Faces up to this angle from parallel, and this much more per overlap, meet face to face; such contacts
    /// are not sought here [rad, rad/m].
    double face_angle = 0, angle_per_depth = 0;
    /// A meeting of faces is preferred unless it is deeper by more than this; positive [m].
    double tie = 0;
    double reach = 0;  ///< points farther open than this are left out [m]
};

/// The contact normal is the axis of largest gap or least overlap: a face's normal or the cross product of
/// two edges (separating-axis theorem; Gottschalk, Lin and Manocha 1996). Where that axis is a face's normal
/// and the other block lies on it with a face, no point is found: contacts/face_pairs.h treats it. For parts
/// of bodies only axes along which the bodies touch (PartOfBody) count, and only vertices and edges of the
/// body. On a face up to four of the other block's vertices, and of the places where its edges cross the
/// face's outline.
VertexEdgePoints findVertexEdgePoints(const WorldShape& first, const WorldShape& second,
                                      const VertexEdgeLimits& limits);

/// Contact that two blocks may reach within displacements of up to `travel` [m] and turns of up to `turn`
/// [rad].
enum class Approach : std::uint8_t {
    apart,       ///< farther from each other than the limits' reach
    faces,       ///< face to face at most
    vertex_edge  ///< findVertexEdgePoints may find something
};
Approach approachOf(const WorldShape& first, const WorldShape& second, const VertexEdgeLimits& limits,
                    double travel, double turn);

/// Whether they are certainly farther apart than `distance` [m], by the normals of their faces alone.
bool areApart(const WorldShape& first, const WorldShape& second, double distance);

}  // namespace talus
