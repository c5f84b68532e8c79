#pragma once
// Polygons in the order in which they are painted, so that what is nearer covers what is farther. Pure
// geometry.

#include <cstdint>
#include <vector>

#include "talus/polyhedron.h"

namespace talus::tools {

/// What a side of a polygon is drawn as.
enum class Side : std::uint8_t {
    none,    ///< a cut that only the painter made, or between parts of one body
    crease,  ///< the same block goes on beyond it, a little turned
    rim,     ///< a sharp edge of a block
    joint    ///< another block goes on beyond it
};

/// A plane convex polygon that looks at the reader, seen in parallel projection: x to the right, y up, z
/// towards the reader.
struct PaintedPolygon {
    std::vector<Vec3> corners;
    std::vector<Side> sides;  ///< from each corner to the next
    std::size_t source = 0;   ///< whose polygon it is; pieces keep it
};

/// The farthest first. Polygons that no order can be found for are cut. Where there are many, the picture is
/// cut into cells first: within one the order is that of a tree of planes (Fuchs, Kedem and Naylor 1980),
/// whose splitting planes are the polygons' own.
std::vector<PaintedPolygon> paintOrder(std::vector<PaintedPolygon> polygons);

}  // namespace talus::tools
