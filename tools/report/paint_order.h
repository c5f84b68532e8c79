#pragma once
// Polygons in the order of painting, so that nearer ones cover farther ones. Pure geometry.

#include <cstdint>
#include <vector>

#include "talus/polyhedron.h"

namespace talus::tools {

/// Kind of a polygon's side.
enum class Side : std::uint8_t {
    none,    ///< a cut that only the painter made, or between parts of one body
    crease,  ///< the same block goes on beyond it, a little turned
    rim,     ///< a sharp edge of a block
    joint    ///< another block goes on beyond it
};

/// A plane convex polygon that faces the reader, in parallel projection: x to the right, y up, z towards the
/// reader.
struct PaintedPolygon {
    std::vector<Vec3> corners;
    std::vector<Side> sides;  ///< from each corner to the next
    std::size_t source = 0;   ///< whose polygon it is; pieces keep it
};

/// The farthest first. Polygons without an order are cut. With many polygons the picture is cut into cells
/// first. Within a cell the order is that of a tree of planes (Fuchs, Kedem and Naylor 1980), whose splitting
/// planes are the polygons' own.
std::vector<PaintedPolygon> paintOrder(std::vector<PaintedPolygon> polygons);

}  // namespace talus::tools
