// Selection of blocks of a rock mass by place.

#include <algorithm>

#include "talus/rock_mass.h"

namespace talus {
namespace {

bool liesInPlane(const Polyhedron& shape, const std::vector<std::int32_t>& face,
                 const BlockSelection& selection, double tolerance) {
    return std::all_of(face.begin(), face.end(), [&](std::int32_t v) {
        return std::abs(selection.upward_normal.dot(shape.vertices[static_cast<std::size_t>(v)] -
                                                    selection.point)) <= tolerance;
    });
}

struct Heights {
    double low = kInfinity, high = -kInfinity;  ///< above the plane [m]
};

Heights heightsOf(const Polyhedron& shape, const BlockSelection& selection) {
    Heights heights;
    for (const Vec3& v : shape.vertices) {
        const double height = selection.upward_normal.dot(v - selection.point);
        heights.low = std::min(heights.low, height);
        heights.high = std::max(heights.high, height);
    }
    return heights;
}

bool takes(const BlockSelection& selection, const Polyhedron& shape, double tolerance) {
    switch (selection.kind) {
        case BlockSelection::Kind::box: {
            const Vec3 centroid = massProperties(shape).centroid;
            return (centroid.array() >= selection.min.array()).all() &&
                   (centroid.array() <= selection.max.array()).all();
        }
        case BlockSelection::Kind::below:
            return heightsOf(shape, selection).high <= tolerance;
        case BlockSelection::Kind::above:
            return heightsOf(shape, selection).low >= -tolerance;
        default:
            break;
    }
    for (std::size_t f = 0; f < shape.faces.size(); ++f)
        if (!shape.isInner(f) && liesInPlane(shape, shape.faces[f], selection, tolerance)) return true;
    return false;
}

}  // namespace

std::vector<bool> selectBlocks(const CutRockMass& mass, const BlockSelection& selection, double tolerance) {
    std::vector<bool> taken;
    for (const CutBlock& block : mass.blocks) taken.push_back(takes(selection, block.shape, tolerance));
    return taken;
}

std::int32_t blockAt(const CutRockMass& mass, const Vec3& point) {
    for (std::size_t b = 0; b < mass.blocks.size(); ++b)
        if (contains(mass.blocks[b].shape, point)) return static_cast<std::int32_t>(b);
    return -1;
}

}  // namespace talus
