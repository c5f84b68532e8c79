#pragma once
// Visible parts of a painted picture: parts covered by later polygons are left out. Pure geometry.

#include <vector>

#include "report/paint_order.h"

namespace talus::tools {

/// A stretch of a polygon's side that nothing covers.
struct SeenLine {
    Vec3 from, to;
    Side side = Side::none;
};

struct SeenParts {
    std::vector<PaintedPolygon>
        polygons;                 ///< in the order of painting; those that are covered wholly are left out
    std::vector<SeenLine> lines;  ///< to be drawn over all of them: creases first, joints last
};

/// A polygon of which only slivers show, thinner than 1e-4 of the picture, counts as covered. Rounding leaves
/// such gaps between the polygons that cover it.
/// \param painted  farthest first, as paintOrder gives them
SeenParts seenParts(std::vector<PaintedPolygon> painted);

}  // namespace talus::tools
