#pragma once
// How high a water stands in its joint.

#include <optional>

#include "state/arrays.h"

namespace talus {

/// Heights along gravity above the model's origin [m].
struct JointLevel {
    double level = 0;  ///< as the scenario gives it: a depth or an elevation
    double table = 0;  ///< where the water table stands
    double low = 0;    ///< lowest end of the walls, those on fixed blocks included
    double high = 0;   ///< highest end of the walls, likewise
};

/// Nothing for heads, for dry water, and for water before walls that all look one way, as a reservoir's.
/// Reads: model, load, walls of water; poses as built
/// \param over_time  at the highest of its levels over time; else at that of time 0
std::optional<JointLevel> jointLevel(const State& state, std::size_t water, bool over_time);

}  // namespace talus
