#pragma once
// A recorded motion of the fixed blocks. All is computed in their frame: free blocks feel the opposite of its
// acceleration, and displacements are relative to the ground.
//
// Reads: the model's ground motion; load.time, load.shaken

#include <algorithm>

#include "state/arrays.h"

namespace talus {

/// [m/s^2]; at a jump the value after it.
inline Vec3 accelerationAt(const GroundMotion& motion, double time) {
    const auto after = std::upper_bound(motion.time.begin(), motion.time.end(), time);
    if (after == motion.time.begin() || after == motion.time.end()) return Vec3::Zero();
    const auto k = static_cast<std::size_t>(after - motion.time.begin());
    const double share = (time - motion.time[k - 1]) / (motion.time[k] - motion.time[k - 1]);
    return motion.acceleration[k - 1] + share * (motion.acceleration[k] - motion.acceleration[k - 1]);
}

inline Vec3 groundAcceleration(const State& state) {
    if (!state.load.shaken) return Vec3::Zero();
    return accelerationAt(state.geometry->model.ground_motion, state.load.time);
}

}  // namespace talus
