#pragma once
// How near two faces lie at the start if they touch.

namespace talus {

/// Of the smaller block's size: faces nearer than this are closed and unstressed at the start.
inline constexpr double kClosedGap = 1e-4;

}  // namespace talus
