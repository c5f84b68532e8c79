#pragma once
// Candidate separating axes of two convex parts: the normals of their faces and the cross products of their
// edges (separating-axis theorem; Gottschalk, Lin and Manocha 1996).

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/world_shape.h"

namespace talus::axes {

struct Edge {
    std::int32_t from, to;     ///< vertices
    std::int32_t left, right;  ///< faces
    Vec3 direction;            ///< unit
    Vec3 arc;                  ///< cross product of the two faces' normals
};

/// In the order of their vertices.
std::vector<Edge> edgesOf(const WorldShape& shape);

struct Pair {
    const WorldShape &first, &second;
    std::vector<Edge> first_edges{}, second_edges{};

    const WorldShape& shape(bool is_second) const { return is_second ? second : first; }
};

/// A candidate separating axis.
struct SeparatingAxis {
    double distance = -std::numeric_limits<double>::infinity();
    bool is_edges = false;
    bool second_is_reference = false;  ///< whose face it is
    std::int32_t face = -1;            ///< its index; of edges: the first block's edge
    std::int32_t other = -1;           ///< the other block's lowest vertex; of edges: the second block's edge
    Vec3 normal = Vec3::Zero();        ///< from the reference (of edges: the first) to the other
};

inline const Vec3& vertexOf(const WorldShape& shape, std::int32_t v) {
    return shape.vertices[static_cast<std::size_t>(v)];
}

/// \param face  of the reference
SeparatingAxis faceAxis(const Pair& pair, bool second_is_reference, std::size_t face);

/// The cross product of two edges; none if they are parallel to rounding.
SeparatingAxis edgeAxis(const Pair& pair, std::size_t e, std::size_t f);

/// One block's face normals along the arcs of the other's edges.
class AlongArcs {
 public:
    AlongArcs(const std::vector<Edge>& edges, std::span<const Vec3> normals) : faces_(normals.size()) {
        along_.reserve(edges.size() * faces_);
        for (const Edge& edge : edges)
            for (const Vec3& normal : normals) along_.push_back(normal.dot(edge.arc));
    }
    double at(std::size_t edge, std::int32_t face) const {
        return along_[edge * faces_ + static_cast<std::size_t>(face)];
    }

 private:
    std::size_t faces_;
    std::vector<double> along_;
};

/// Pairs of edges that are outermost in both blocks along their cross product. On the unit sphere, the arc
/// between the normals of one edge's faces crosses the arc between the negated normals of the other's (the
/// Gauss map; Gregorius 2013).
class GaussMap {
 public:
    explicit GaussMap(const Pair& pair)
        : pair_(pair),
          second_along_first_(pair.first_edges, pair.second.normals),
          first_along_second_(pair.second_edges, pair.first.normals) {}

    bool cross(std::size_t e, std::size_t f) const {
        const Edge &first = pair_.first_edges[e], &second = pair_.second_edges[f];
        const double second_left = second_along_first_.at(e, second.left);
        if (second_left * second_along_first_.at(e, second.right) >= 0) return false;
        const double first_right = first_along_second_.at(f, first.right);
        return first_along_second_.at(f, first.left) * first_right < 0 && second_left * first_right < 0;
    }

 private:
    const Pair& pair_;
    AlongArcs second_along_first_, first_along_second_;
};

/// Calls each(axis) for all axes until it returns false. The pair's edges are computed on first use.
template <class Each>
void forEachAxis(Pair& pair, const Each& each) {
    for (std::size_t face = 0; face < pair.first.faces.size(); ++face)
        if (!each(faceAxis(pair, false, face))) return;
    for (std::size_t face = 0; face < pair.second.faces.size(); ++face)
        if (!each(faceAxis(pair, true, face))) return;
    pair.first_edges = edgesOf(pair.first);
    pair.second_edges = edgesOf(pair.second);
    const GaussMap map(pair);
    for (std::size_t e = 0; e < pair.first_edges.size(); ++e)
        for (std::size_t f = 0; f < pair.second_edges.size(); ++f) {
            if (!map.cross(e, f)) continue;
            const SeparatingAxis axis = edgeAxis(pair, e, f);
            if (axis.is_edges && !each(axis)) return;
        }
}

}  // namespace talus::axes
