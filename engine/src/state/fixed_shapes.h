#pragma once
// Fixed blocks at their places. They never move, so they are placed once, in the build. A search for contacts
// visits only their parts near another block: a ground of 100,000 triangles costs it no more than a plane.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/box_tree.h"
#include "geometry/parts.h"
#include "talus/polyhedron.h"

namespace talus {

struct FixedShapes {
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

    std::vector<std::size_t> first_vertex{}, first_normal{};  ///< of each block; kNone of one that may move
    std::vector<Vec3> vertices{};                             ///< [m]
    std::vector<Vec3> normals{};                              ///< outward unit normal per face
    std::vector<std::int32_t> parts{};                        ///< as Geometry numbers them, ascending
    BoxTree boxes{};                                          ///< of these parts, in their order
    /// Touching blocks as one body with these parts in their order, whose surface other blocks meet.
    /// Otherwise a block that slides over two level tops would catch on the edge between them by its elastic
    /// overlap. Empty where no two touch.
    Polyhedron together{};
    std::vector<FacePlane> planes{};  ///< of its faces
    double tolerance = 0;             ///< of PartOfBody [m]

    bool has(std::size_t block) const { return block < first_vertex.size() && first_vertex[block] != kNone; }
};

}  // namespace talus
