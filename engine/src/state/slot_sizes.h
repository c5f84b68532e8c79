#pragma once
// How many doubles a slot has, of interfaces, corners and contact points (state/lane_array.h); kernels may
// see this, not the rest.

#include <cstddef>

namespace talus {

inline constexpr std::size_t kFrameQuantities = 21;  ///< see InterfaceFrame
inline constexpr std::size_t kReferenceGap = 18;     ///< where in these its gap and slopes are
inline constexpr std::size_t kWrenchQuantities = 9;  ///< see InterfaceWrench
inline constexpr std::size_t kCornerQuantities = 2;  ///< along e1, e2 from the origin [m]
inline constexpr std::size_t kPlaceQuantities = 3;   ///< along e1, e2 from the origin [m], A_s [m^2]
inline constexpr std::size_t kSlideQuantities = 2;   ///< plastic slide along e1, e2 [m]
inline constexpr std::size_t kMemoryQuantities = 4;  ///< beside it bond and dilation

}  // namespace talus
