#pragma once
// A convex block, or a convex part of one, at its present pose, without copies of constant data.

#include <cstdint>
#include <span>
#include <vector>

#include "talus/polyhedron.h"

namespace talus {

struct PartOfBody;  // geometry/parts.h

/// Of a convex part, by number: the vertices at its ends, the lower first, and the two faces that it belongs
/// to.
struct PartEdge {
    std::int32_t from, to;
    std::int32_t left, right;
};

/// In the order of their vertices.
std::vector<PartEdge> partEdges(std::span<const std::vector<std::int32_t>> faces);

/// A convex part of a body as it stands in the world; refers to the caller's arrays.
struct WorldShape {
    std::span<const Vec3> vertices;                    ///< [m]
    std::span<const std::vector<std::int32_t>> faces;  ///< as in Polyhedron
    std::span<const Vec3> normals;                     ///< outward unit normal per face
    std::span<const Cover> covers{};                   ///< per face; none where the part is the whole body
    const PartOfBody* body = nullptr;                  ///< none where the part is the whole body
    std::span<const PartEdge> edges{};                 ///< none: those of the faces, to be found

    /// Whether a face is inside the body.
    bool isInner(std::size_t face) const { return !covers.empty() && covers[face] == Cover::wholly; }
};

}  // namespace talus
