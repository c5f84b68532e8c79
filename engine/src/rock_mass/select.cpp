// Which blocks of a rock mass a user means: by place.

#include <algorithm>

#include "talus/rock_mass.h"

namespace talus {
namespace {

/// Sums over the parts of each block.
struct BlockSum {
    double volume = 0;
    Vec3 moment = Vec3::Zero();
    double low = kInfinity, high = -kInfinity;  ///< heights above the plane [m]
    bool has_face = false;
};

bool liesInPlane(const Polyhedron& shape, const std::vector<std::int32_t>& face,
                 const BlockSelection& selection, double tolerance) {
    return std::all_of(face.begin(), face.end(), [&](std::int32_t v) {
        return std::abs(selection.upward_normal.dot(shape.vertices[static_cast<std::size_t>(v)] -
                                                    selection.point)) <= tolerance;
    });
}

void add(const BlockPart& part, const BlockSelection& selection, double tolerance, BlockSum& sum) {
    if (selection.kind == BlockSelection::Kind::box) {
        sum.volume += part.volume;
        sum.moment += part.volume * massProperties(part.shape).centroid;
        return;
    }
    for (const Vec3& v : part.shape.vertices) {
        const double height = selection.upward_normal.dot(v - selection.point);
        sum.low = std::min(sum.low, height);
        sum.high = std::max(sum.high, height);
    }
    if (selection.kind != BlockSelection::Kind::touching) return;
    for (const auto& face : part.shape.faces)
        sum.has_face = sum.has_face || liesInPlane(part.shape, face, selection, tolerance);
}

bool takes(const BlockSelection& selection, const BlockSum& sum, double tolerance) {
    switch (selection.kind) {
        case BlockSelection::Kind::box: {
            const Vec3 centroid = sum.moment / sum.volume;
            return (centroid.array() >= selection.min.array()).all() &&
                   (centroid.array() <= selection.max.array()).all();
        }
        case BlockSelection::Kind::below:
            return sum.high <= tolerance;
        case BlockSelection::Kind::above:
            return sum.low >= -tolerance;
        default:
            return sum.has_face;
    }
}

bool contains(const Polyhedron& shape, const Vec3& point) {
    for (std::size_t f = 0; f < shape.faces.size(); ++f)
        if (shape.faceNormal(f).dot(point - shape.vertices[static_cast<std::size_t>(shape.faces[f][0])]) > 0)
            return false;
    return true;
}

}  // namespace

std::vector<bool> selectBlocks(const CutRockMass& mass, const BlockSelection& selection, double tolerance) {
    std::vector<BlockSum> sums(static_cast<std::size_t>(mass.blocks));
    for (const BlockPart& part : mass.parts)
        add(part, selection, tolerance, sums[static_cast<std::size_t>(part.block)]);
    std::vector<bool> taken(mass.parts.size());
    for (std::size_t p = 0; p < mass.parts.size(); ++p)
        taken[p] = takes(selection, sums[static_cast<std::size_t>(mass.parts[p].block)], tolerance);
    return taken;
}

std::int32_t blockAt(const CutRockMass& mass, const Vec3& point) {
    for (const BlockPart& part : mass.parts)
        if (contains(part.shape, point)) return part.block;
    return -1;
}

}  // namespace talus
