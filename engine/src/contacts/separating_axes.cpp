#include "contacts/separating_axes.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace talus::axes {
namespace {

constexpr double kParallelEdges =
    1e-6;  // sine of the angle below which two edges have no cross product worth the name

}  // namespace

void findEdges(const WorldShape& shape, std::pmr::vector<Edge>& edges) {
    const std::vector<PartEdge> found =
        shape.edges.empty() ? partEdges(shape.faces) : std::vector<PartEdge>{};
    const std::span<const PartEdge> known = shape.edges.empty() ? std::span(found) : shape.edges;
    edges.clear();
    edges.reserve(known.size());
    for (const PartEdge& edge : known) {
        const Vec3 along = shape.vertices[static_cast<std::size_t>(edge.to)] -
                           shape.vertices[static_cast<std::size_t>(edge.from)];
        edges.push_back({edge.from, edge.to, edge.left, edge.right, along.normalized(),
                         shape.normals[static_cast<std::size_t>(edge.left)].cross(
                             shape.normals[static_cast<std::size_t>(edge.right)])});
    }
}

SeparatingAxis faceAxis(const Pair& pair, bool second_is_reference, std::size_t face, double enough) {
    const WorldShape& reference = pair.shape(second_is_reference);
    const WorldShape& other = pair.shape(!second_is_reference);
    SeparatingAxis axis{std::numeric_limits<double>::infinity(), false, second_is_reference,
                        static_cast<std::int32_t>(face),         -1,    reference.normals[face]};
    const Vec3& origin = vertexOf(reference, reference.faces[face][0]);
    for (std::size_t v = 0; v < other.vertices.size() && axis.distance > enough; ++v) {
        const double height = axis.normal.dot(other.vertices[v] - origin);
        if (height < axis.distance) axis.distance = height, axis.other = static_cast<std::int32_t>(v);
    }
    return axis;
}

SeparatingAxis edgeAxis(const Pair& pair, std::size_t e, std::size_t f) {
    const Edge &first = pair.first_edges[e], &second = pair.second_edges[f];
    Vec3 normal = first.direction.cross(second.direction);
    const double sine = normal.norm();
    if (sine < kParallelEdges) return {};
    normal /= sine;
    const auto& normals = pair.first.normals;
    const Vec3 outwards =
        normals[static_cast<std::size_t>(first.left)] + normals[static_cast<std::size_t>(first.right)];
    if (normal.dot(outwards) < 0) normal = -normal;
    const double distance = normal.dot(vertexOf(pair.second, second.from) - vertexOf(pair.first, first.from));
    return {distance, true, false, static_cast<std::int32_t>(e), static_cast<std::int32_t>(f), normal};
}

double mostAlong(const Pair& pair, const Edge& edge, std::int32_t vertex_of_second) {
    // Of the distance to the vertex: the axis of edges at kParallelEdges is known to 1e-10.
    constexpr double kRounding = 1e-6;
    const Vec3 w = vertexOf(pair.second, vertex_of_second) - vertexOf(pair.first, edge.from);
    const auto along = [&](std::int32_t face) {
        return pair.first.normals[static_cast<std::size_t>(face)].dot(w);
    };
    const double most = std::max(along(edge.left), along(edge.right)) + kRounding * w.norm();
    return most < 0 ? most : std::numeric_limits<double>::infinity();
}

}  // namespace talus::axes
