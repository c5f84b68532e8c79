#include "mesh/grid.h"

#include <algorithm>
#include <cmath>

namespace talus::formats::mesh {

void addSquares(const HeightGrid& grid, SurfaceBuilder& builder) {
    const auto height = [&](std::int32_t v) { return grid.heights[static_cast<std::size_t>(v)]; };
    for (std::size_t row = grid.rows - 1; row-- > 0;) {
        for (std::size_t column = 0; column + 1 < grid.columns; ++column) {
            const std::size_t at = row * grid.columns + column;
            const std::int32_t nw = grid.vertices[at], ne = grid.vertices[at + 1],
                               sw = grid.vertices[at + grid.columns],
                               se = grid.vertices[at + grid.columns + 1];
            if (std::min({nw, ne, sw, se}) < 0) continue;
            const int line = grid.lines.empty() ? 0 : grid.lines[row];
            if (std::abs(height(sw) - height(ne)) <= std::abs(height(se) - height(nw))) {
                builder.triangle({sw, se, ne}, line);
                builder.triangle({sw, ne, nw}, line);
            } else {
                builder.triangle({sw, se, nw}, line);
                builder.triangle({se, ne, nw}, line);
            }
        }
    }
}

}  // namespace talus::formats::mesh
