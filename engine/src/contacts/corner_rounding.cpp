#include "contacts/corner_rounding.h"

#include "forces/contact_forces.h"
#include "state/incidence.h"
#include "state/placed_shape.h"

namespace talus {
namespace {

constexpr double kKink = 0.7071067811865476;  // cosine of the most that two faces turn by at a kink
// Of the smaller block's size. More than what a search has to see of a failure (analysis/load_search.cpp), so that no verdict hangs
// on a corner's sharpness.
constexpr double kCornerRounding = 1e-3;
constexpr double kCornerTie = 1e-6;  // likewise: what makes clear how two corners meet

/// Faces of a block that a point lies on, or nearer than `distance` [m]; none when it is farther from the block.
int facesAt(const State& state, std::int32_t block, const Vec3& point, double distance) {
    const Polyhedron& shape = state.geometry->shape[static_cast<std::size_t>(block)];
    const Vec3 own = toOwn(state.blocks, block, point);
    int count = 0;
    for (std::size_t face = 0; face < shape.faces.size(); ++face) {
        const Vec3& on_face = shape.vertices[static_cast<std::size_t>(shape.faces[face].front())];
        const double height = shape.faceNormal(face).dot(own - on_face);
        if (height > distance) return 0;
        if (height >= -distance) ++count;
    }
    return count;
}

/// Whether a face of a block lies, up to a point, on a block other than its partner.
/// \param least cosine of the angle between that face and the contact, whose normal points to the block
bool isCarriedAt(const State& state, std::int32_t block, std::int32_t partner, const Vec3& point,
                 const Vec3& normal, double least, double distance) {
    const Interfaces& f = state.interfaces;
    const Incidence& incidence = state.incidence;
    const auto b = static_cast<std::size_t>(block);
    for (auto k = incidence.interface_begin[b]; k < incidence.interface_begin[b + 1]; ++k) {
        const auto i = static_cast<std::size_t>(incidence.interface[static_cast<std::size_t>(k)]);
        if (isVertexEdge(f, i)) continue;
        const bool is_a = f.block_a[i] == block;
        const std::int32_t third = is_a ? f.block_b[i] : f.block_a[i];
        if (third == partner) continue;
        const double cosine = relativePose(state, i).e3.dot(normal) * (is_a ? -1.0 : 1.0);
        if (cosine >= least && facesAt(state, third, point, distance) > 0) return true;
    }
    return false;
}

}  // namespace

bool isRoundedOff(const State& state, std::size_t interface, const VertexEdgePoint& point, double size) {
    const double rounding = kCornerRounding * size, tie = kCornerTie * size;
    if (point.gap <= -rounding) return false;
    const Interfaces& f = state.interfaces;
    const std::int32_t reference = point.second_is_reference ? f.block_b[interface] : f.block_a[interface];
    const std::int32_t other = point.second_is_reference ? f.block_a[interface] : f.block_b[interface];
    const Vec3 normal = point.e1.cross(point.e2);
    if (isCarriedAt(state, other, reference, point.on_other, normal, kKink, rounding)) return true;
    if (point.gap <= -tie) return false;
    const bool are_corners =
        facesAt(state, reference, point.on_other, tie) > 1 && facesAt(state, other, point.on_other, tie) > 1;
    return are_corners && (isCarriedAt(state, other, reference, point.on_other, normal, -1.0, rounding) ||
                           isCarriedAt(state, reference, other, point.on_other, normal, -1.0, rounding));
}

}  // namespace talus
