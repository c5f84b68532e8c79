#pragma once
// Blocks that the model holds fixed, where they stand. Nothing moves them, so they are placed once,
// when the model is built, and a search for contacts looks only at those of their parts that another
// block is near to: a ground of 100,000 triangles costs a search what a plane does.

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
    /// Blocks that touch each other, as one body with these parts in their order: its surface is what other
    /// blocks meet. Else a block that slides over two blocks whose tops are level would hang on the edge
    /// between them by as much as it is pressed into its joint. Empty where no two touch.
    Polyhedron together{};
    std::vector<FacePlane> planes{};  ///< of its faces
    double tolerance = 0;             ///< of PartOfBody [m]

    bool has(std::size_t block) const { return block < first_vertex.size() && first_vertex[block] != kNone; }
};

}  // namespace talus
