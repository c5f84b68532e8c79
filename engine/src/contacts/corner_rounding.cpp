#include "contacts/corner_rounding.h"

#include <algorithm>
#include <vector>

#include "contacts/limits.h"
#include "forces/contact_forces.h"
#include "state/incidence.h"
#include "state/placed_shape.h"

namespace talus {
namespace {

constexpr double kKink = 0.7071067811865476;  // cosine of the most that two faces turn by at a kink
// Of the smaller block's size. More than the failure displacement of a search, so that no verdict depends
// on a corner's sharpness.
constexpr double kCornerRounding = 1e-3;
constexpr double kSameWay = 1e-6;    // [rad]
constexpr double kCornerTie = 1e-6;  // likewise: enough to decide how two corners meet

/// Normals of the faces of a convex shape within `distance` [m] of a point, or of its faces `first` to `end`
/// for one part. None when the point is farther from the shape; inner faces do not count.
std::vector<Vec3> normalsAt(const Polyhedron& shape, std::size_t first, std::size_t end, const Vec3& point,
                            double distance) {
    std::vector<Vec3> normals;
    for (std::size_t face = first; face < end; ++face) {
        const Vec3& on_face = shape.vertices[static_cast<std::size_t>(shape.faces[face].front())];
        const Vec3 normal = shape.faceNormal(face);
        const double height = normal.dot(point - on_face);
        if (height > distance) return {};
        if (height >= -distance && !shape.isInner(face)) normals.push_back(normal);
    }
    return normals;
}

/// Parts of a block that may hold a point or lie within `distance` [m] of it; ascending. For a fixed block as
/// built, those found in its tree.
std::vector<std::size_t> partsAt(const State& state, std::int32_t block, const Vec3& point, double distance) {
    // Where faces meet at an angle w, a point within the distance of both planes may be 2/w times that from
    // their edge. Only wedges of less than two thousandths reach farther than this.
    constexpr double kSharpest = 1000.0;
    const auto b = static_cast<std::size_t>(block);
    const Geometry& geometry = *state.geometry;
    const std::int32_t first = geometry.first_part[b], end = geometry.first_part[b + 1];
    std::vector<std::size_t> parts;
    if (standsAsBuilt(state, b)) {
        geometry.fixed.boxes.visit(Box{point, point}.grown(kSharpest * distance), [&](std::size_t k) {
            const std::int32_t part = geometry.fixed.parts[k];
            if (part >= first && part < end) parts.push_back(static_cast<std::size_t>(part - first));
        });
        std::sort(parts.begin(), parts.end());
    } else {
        for (std::int32_t part = first; part < end; ++part)
            parts.push_back(static_cast<std::size_t>(part - first));
    }
    return parts;
}

/// Faces of a block within `distance` [m] of a point; none when it is farther from the block. Faces of
/// several parts with the same normal count once.
std::size_t facesAt(const State& state, std::int32_t block, const Vec3& point, double distance) {
    const Polyhedron& shape = state.geometry->shape[static_cast<std::size_t>(block)];
    const Vec3 own = toOwn(state.blocks, block, point);
    if (shape.partCount() == 1) return normalsAt(shape, 0, shape.faces.size(), own, distance).size();
    std::vector<Vec3> different;
    for (const std::size_t p : partsAt(state, block, point, distance)) {
        const ConvexPart& part = shape.faces.parts()[p];
        const auto first = static_cast<std::size_t>(part.first_face);
        for (const Vec3& normal : normalsAt(shape, first, first + part.faces.size(), own, distance))
            if (std::none_of(different.begin(), different.end(),
                             [&](const Vec3& known) { return (known - normal).norm() < kSameWay; }))
                different.push_back(normal);
    }
    return different.size();
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

/// Depth up to which a corner at a kink is left out, as a share of the smaller block's size. A contact placed
/// later counts its gap from there. Where springs keep their energy, only the blocks' motion reduces that
/// overlap (contacts/gap_recovery.h), and blocks in equilibrium have none. There the depth is that of
/// touching faces: with 1e-3 a slab that stopped in the angle of two beds lay 7e-4 of its size deep in one of
/// them.
double roundingOf(const State& state) {
    return state.springs == Springs::keep_energy ? kClosedGap : kCornerRounding;
}

}  // namespace

bool isRoundedOff(const State& state, std::size_t interface, const VertexEdgePoint& point, double size) {
    const double rounding = roundingOf(state) * size, tie = kCornerTie * size;
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
