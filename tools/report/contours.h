#pragma once
// Rings around where a field exceeds a level.

#include <cstddef>
#include <functional>
#include <vector>

#include "report/figures.h"

namespace talus::tools {

/// Values at the points of a square grid over [-reach, reach]^2, row by row from the bottom.
struct Field {
    std::size_t side = 0;  ///< points along each side
    double reach = 1;
    std::vector<double> values;

    Spot spot(std::size_t i, std::size_t j) const;
    double at(std::size_t i, std::size_t j) const { return values[j * side + i]; }
};

Field sampled(std::size_t side, double reach, const std::function<double(Spot)>& value);

/// Closed rings around where the field, linear along the grid's lines, is above the level (marching squares;
/// W. E. Lorensen and H. E. Cline 1987 in the plane). What is above is on the left of each ring. The
/// outermost points count as below the level.
std::vector<std::vector<Spot>> ringsAbove(const Field& field, double level);

}  // namespace talus::tools
