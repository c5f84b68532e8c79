#include "contacts/separating_axes.h"

#include <algorithm>
#include <cstdint>

namespace talus::axes {
namespace {

constexpr double kParallel =
    1e-6;  // sine of the angle below which two edges have no cross product worth the name

/// An edge as one of its faces lists it. A whole number sorts faster than three, by lower vertex, higher vertex and face.
class HalfEdge {
 public:
    HalfEdge(std::int32_t from, std::int32_t to, std::size_t face)
        : key_(static_cast<std::uint64_t>(std::min(from, to)) << 2 * kBits |
               static_cast<std::uint64_t>(std::max(from, to)) << kBits | face) {}

    std::int32_t low() const { return static_cast<std::int32_t>(key_ >> 2 * kBits); }
    std::int32_t high() const { return static_cast<std::int32_t>(key_ >> kBits & kMask); }
    std::int32_t face() const { return static_cast<std::int32_t>(key_ & kMask); }
    bool operator<(const HalfEdge& other) const { return key_ < other.key_; }

 private:
    static constexpr unsigned kBits = 21;  // of vertices and faces of one convex part
    static constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;
    std::uint64_t key_;
};

}  // namespace

std::vector<Edge> edgesOf(const WorldShape& shape) {
    std::vector<HalfEdge> halves;
    halves.reserve(2 * (shape.vertices.size() + shape.faces.size()));  // Euler: twice their number less 2
    for (std::size_t face = 0; face < shape.faces.size(); ++face) {
        const auto& outline = shape.faces[face];
        for (std::size_t i = 0; i < outline.size(); ++i)
            halves.emplace_back(outline[i], outline[i + 1 < outline.size() ? i + 1 : 0], face);
    }
    std::sort(halves.begin(), halves.end());
    std::vector<Edge> edges;
    edges.reserve(halves.size() / 2);
    for (std::size_t i = 0; i + 1 < halves.size(); i += 2) {  // each edge belongs to two faces
        const HalfEdge &left = halves[i], &right = halves[i + 1];
        const Vec3 along = shape.vertices[static_cast<std::size_t>(left.high())] -
                           shape.vertices[static_cast<std::size_t>(left.low())];
        edges.push_back({left.low(), left.high(), left.face(), right.face(), along.normalized(),
                         shape.normals[static_cast<std::size_t>(left.face())].cross(
                             shape.normals[static_cast<std::size_t>(right.face())])});
    }
    return edges;
}

SeparatingAxis faceAxis(const Pair& pair, bool second_is_reference, std::size_t face) {
    const WorldShape& reference = pair.shape(second_is_reference);
    const WorldShape& other = pair.shape(!second_is_reference);
    SeparatingAxis axis{std::numeric_limits<double>::infinity(), false, second_is_reference,
                        static_cast<std::int32_t>(face),         -1,    reference.normals[face]};
    const Vec3& origin = vertexOf(reference, reference.faces[face][0]);
    for (std::size_t v = 0; v < other.vertices.size(); ++v) {
        const double height = axis.normal.dot(other.vertices[v] - origin);
        if (height < axis.distance) axis.distance = height, axis.other = static_cast<std::int32_t>(v);
    }
    return axis;
}

SeparatingAxis edgeAxis(const Pair& pair, std::size_t e, std::size_t f) {
    const Edge &first = pair.first_edges[e], &second = pair.second_edges[f];
    Vec3 normal = first.direction.cross(second.direction);
    const double sine = normal.norm();
    if (sine < kParallel) return {};
    normal /= sine;
    const auto& normals = pair.first.normals;
    const Vec3 outwards =
        normals[static_cast<std::size_t>(first.left)] + normals[static_cast<std::size_t>(first.right)];
    if (normal.dot(outwards) < 0) normal = -normal;
    const double distance = normal.dot(vertexOf(pair.second, second.from) - vertexOf(pair.first, first.from));
    return {distance, true, false, static_cast<std::int32_t>(e), static_cast<std::int32_t>(f), normal};
}

}  // namespace talus::axes
