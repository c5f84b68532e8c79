#pragma once
// Walls below a phreatic surface, now or later: all faces of free blocks.

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "talus/polyhedron.h"

namespace talus {

namespace phreatic {
struct Cells;    // forces/phreatic.h
struct Outline;  // likewise
}  // namespace phreatic

struct PhreaticWalls {
    std::vector<std::int32_t> block;    ///< of each wall, block by block
    std::vector<std::uint8_t> drained;  ///< 1 once its joint has opened wider than the surface allows
    std::vector<Vec3> force,
        moment;  ///< on the block about its centroid, model frame, as last brought up to date [N, N m]

    /// Of each wall's face; they never change.
    std::shared_ptr<const std::vector<phreatic::Outline>> outlines{};

    // Pieces of the surface for the last load, from which they follow.
    std::shared_ptr<const phreatic::Cells> cells;
    double cells_tilt = std::numeric_limits<double>::quiet_NaN(), cells_share = 0;

    std::size_t size() const { return block.size(); }
};

}  // namespace talus
