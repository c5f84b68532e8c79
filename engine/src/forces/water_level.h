#pragma once
// How high a water stands in its joint.

#include <optional>

#include "forces/water_table.h"
#include "state/arrays.h"

namespace talus {

/// Heights along gravity above the model's origin [m].
struct JointHeights {
    TableHeight table{};  ///< where the water table stands, by the level
    double low = 0;       ///< lowest end of the walls, those on fixed blocks included
    double high = 0;      ///< highest end of the walls, likewise
};

/// Nothing for heads, for dry water, and for water before walls that all look one way, as a reservoir's.
/// Reads: model, load.tilt, walls of water; poses as built
std::optional<JointHeights> jointHeights(const State& state, std::size_t water);

}  // namespace talus
