#pragma once
// Candidate separating axes of two convex parts: the normals of their faces and the cross products of their
// edges (separating-axis theorem; Gottschalk, Lin and Manocha 1996).

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory_resource>
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

/// Two convex parts, and their edges once something needs them. Where rocks roll this is made thousands of
/// times a second, so it has room itself for the edges of most parts.
struct Pair {
    Pair(const WorldShape& first_part, const WorldShape& second_part)
        : first(first_part), second(second_part) {}
    Pair(const Pair&) = delete;
    Pair& operator=(const Pair&) = delete;

    const WorldShape& shape(bool is_second) const { return is_second ? second : first; }

    const WorldShape &first, &second;

 private:
    static constexpr std::size_t kBytes = 8192;  // of edges, and of what a GaussMap keeps of them
    std::array<std::byte, kBytes> room_;         // unset, as memory from the heap
    std::pmr::monotonic_buffer_resource memory_{room_.data(), room_.size()};

 public:
    std::pmr::vector<Edge> first_edges{&memory_}, second_edges{&memory_};
};

/// Finds the edges of a part, in the order of their vertices.
void findEdges(const WorldShape& shape, std::pmr::vector<Edge>& edges);

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
/// \param enough  an axis along which they are no farther apart than this may be known no better [m]
SeparatingAxis faceAxis(const Pair& pair, bool second_is_reference, std::size_t face,
                        double enough = -std::numeric_limits<double>::infinity());

/// The cross product of two edges; none if they are parallel to rounding.
SeparatingAxis edgeAxis(const Pair& pair, std::size_t e, std::size_t f);

/// Pairs of edges that are outermost in both blocks along their cross product. On the unit sphere, the arc
/// between the normals of one edge's faces crosses the arc between the negated normals of the other's (the
/// Gauss map; Gregorius 2013).
class GaussMap {
 public:
    explicit GaussMap(const Pair& pair)
        : pair_(pair),
          along_(pair.second.normals.size(), pair.first_edges.get_allocator()),
          parted_(pair.second_edges.size(), pair.first_edges.get_allocator()) {}

    /// Calls use(f) for the second's edges that an edge of the first crosses, in order, until it returns
    /// false. \return whether it never did
    template <class Use>
    bool eachCrossing(std::size_t e, const Use& use) {
        const std::size_t count = findParted(pair_.first_edges[e]);
        for (std::size_t k = 0; k < count; ++k)
            if (cross(pair_.first_edges[e], pair_.second_edges[parted_[k]]) && !use(parted_[k])) return false;
        return true;
    }

 private:
    double along(std::int32_t face) const { return along_[static_cast<std::size_t>(face)]; }

    /// The second's edges whose two normals lie on either side of the first's arc. Without branches, since
    /// the processor cannot predict which edges they are.
    std::size_t findParted(const Edge& first) {
        for (std::size_t face = 0; face < along_.size(); ++face)
            along_[face] = pair_.second.normals[face].dot(first.arc);
        std::size_t count = 0;
        for (std::size_t f = 0; f < pair_.second_edges.size(); ++f) {
            const Edge& second = pair_.second_edges[f];
            parted_[count] = f;
            count += along(second.left) * along(second.right) < 0 ? 1 : 0;
        }
        return count;
    }

    bool cross(const Edge& first, const Edge& second) const {
        const auto& normals = pair_.first.normals;
        const double right = normals[static_cast<std::size_t>(first.right)].dot(second.arc);
        return normals[static_cast<std::size_t>(first.left)].dot(second.arc) * right < 0 &&
               along(second.left) * right < 0;
    }

    const Pair& pair_;
    std::pmr::vector<double> along_;        ///< the second's normals, along the arc of an edge of the first
    std::pmr::vector<std::size_t> parted_;  ///< findParted
};

/// A bound of the distance along any axis of an edge of the first: negative, or infinite where it says
/// nothing [m]. Such an axis n lies between the normals l and r of the edge's faces: n = a l + b r with
/// a + b >= 1. A vertex of the second at w from the edge is as far along n as the second is, or farther.
/// Where both l.w and r.w are negative, n.w is no more than the larger of them.
double mostAlong(const Pair& pair, const Edge& edge, std::int32_t vertex_of_second);

/// Calls each(axis) for all axes until it returns false. The pair's edges are computed on first use.
/// \param floor  floor(is_edges): axes of faces or edges along which they are no farther apart than this do
///               not matter; they may be left out, or be known no better [m]
template <class Each, class Floor>
void forEachAxis(Pair& pair, const Each& each, const Floor& floor) {
    SeparatingAxis farthest;  // of the first's faces: an edge far from its lowest vertex does not matter
    for (const bool of_second : {false, true})
        for (std::size_t face = 0; face < pair.shape(of_second).faces.size(); ++face) {
            const SeparatingAxis axis = faceAxis(pair, of_second, face, floor(false));
            if (!each(axis)) return;
            if (!of_second && axis.distance > farthest.distance) farthest = axis;
        }
    findEdges(pair.first, pair.first_edges);
    findEdges(pair.second, pair.second_edges);
    GaussMap map(pair);
    for (std::size_t e = 0; e < pair.first_edges.size(); ++e) {
        if (mostAlong(pair, pair.first_edges[e], farthest.other) <= floor(true)) continue;
        const bool all = map.eachCrossing(e, [&](std::size_t f) {
            const SeparatingAxis axis = edgeAxis(pair, e, f);
            return !axis.is_edges || each(axis);
        });
        if (!all) return;
    }
}

/// The same for all axes.
template <class Each>
void forEachAxis(Pair& pair, const Each& each) {
    forEachAxis(pair, each, [](bool) { return -std::numeric_limits<double>::infinity(); });
}

}  // namespace talus::axes
