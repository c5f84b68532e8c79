#pragma once
// Degrees, as users write and read them, and radians, as everything computes.

namespace talus {

inline constexpr double kDegree = 0.017453292519943295;  ///< [rad]

constexpr double degrees(double radians) { return radians / kDegree; }
constexpr double radians(double degrees) { return degrees * kDegree; }

}  // namespace talus
