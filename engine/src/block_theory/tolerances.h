#pragma once
// Angles from which on block theory tells directions apart.

namespace talus::keyblocks {

/// A neighbour is in the way of a block that would press into it by more than this share of its path. Along a
/// path as long as the block the two then overlap by no more than the gap that counts as closed at the start
/// (kClosedGap). With less, planes that a scenario gives by rounded coordinates lock; with more, blocks move
/// through each other.
inline constexpr double kInTheWay = 1e-4;

/// Forces that are less than this share of the resultant are none: a factor of safety above a million says
/// nothing.
inline constexpr double kNoForce = 1e-6;

}  // namespace talus::keyblocks
