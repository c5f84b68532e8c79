#pragma once
// Angles from which on block theory tells directions apart.

namespace talus::keyblocks {

/// A neighbour obstructs a block that would press into it by more than this share of its path. Along a path
/// as long as the block the overlap is then at most the gap that counts as closed at the start (kClosedGap).
/// A smaller value locks planes with rounded coordinates; a larger one lets blocks move through each other.
inline constexpr double kInTheWay = 1e-4;

/// Forces of less than this share of the resultant count as zero: a factor of safety above a million has no
/// meaning.
inline constexpr double kNoForce = 1e-6;

}  // namespace talus::keyblocks
