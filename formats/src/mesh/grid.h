#pragma once
// Height grids as triangles.

#include <cstdint>
#include <vector>

#include "mesh/builder.h"

namespace talus::formats::mesh {

/// Heights row by row from the north, each at the middle of its cell.
struct HeightGrid {
    std::size_t columns = 0, rows = 0;
    const std::vector<std::int32_t>& vertices;  ///< of each cell; -1 without a height
    const std::vector<double>& heights;         ///< of each vertex
    const std::vector<int>& lines;              ///< of each row; empty where rows have none
};

/// Adds the squares between four heights, from the south-west on, each as two triangles along the diagonal
/// whose ends differ less. A square that lacks a height is left out. \pre every height has a vertex of its
/// own, numbered in the order of the heights
void addSquares(const HeightGrid& grid, SurfaceBuilder& builder);

}  // namespace talus::formats::mesh
