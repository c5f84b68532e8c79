#pragma once
// Points thinned to one height per cell of a grid.

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/builder.h"

namespace talus::formats::mesh {

/// Heights of cells, row by row from the north.
struct PointGrid {
    std::size_t columns = 0, rows = 0;
    Eigen::Vector2d south_west = Eigen::Vector2d::Zero();  ///< middle of that cell
    std::vector<bool> filled{};                            ///< has a height that is used
    std::vector<double> heights{};                         ///< of all cells; 0 of those not filled
    std::vector<std::string> notes{};                      ///< what was thinned and left out, for the user
};

/// Cells begin at whole multiples of their size. Only the largest piece that hangs together by sides of its
/// squares is kept. \pre points, and a grid of at most mostCells
PointGrid thinned(const std::vector<Vec3>& points, const Thinning& thinning);

/// Most cells for so many points: most cells then have one.
inline double mostCells(std::size_t points) { return std::min(2e7, 1e4 + 100 * static_cast<double>(points)); }
/// Cells of the grid over all points.
double cellsOver(const std::vector<Vec3>& points, double cell);

}  // namespace talus::formats::mesh
