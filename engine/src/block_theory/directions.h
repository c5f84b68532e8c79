#pragma once
// The directions along which groups of blocks are sought. There are as many as planes and pairs of planes, so
// their number has to be bounded; each is one along which some body can slide under the forces there are.

#include <vector>

#include "block_theory/slope.h"

namespace talus::keyblocks {

/// Of a slope's planes the one with the most contact area stands for all within kSameSet of it; then the
/// next. Up to kMostSets such planes give their dip directions and their lines of intersection. Joint sets of
/// a slope are three or four.
inline constexpr double kSameSet = 0.17453292519943295;  ///< 10 degrees [rad]
inline constexpr std::size_t kMostSets = 8;

/// Directions that are tried for every block. Those of the sets come first, then those that blocks have of
/// themselves (dip directions of the planes they press, lines of intersection of two), those of most mass
/// first. Each costs a pass over all contacts.
inline constexpr std::size_t kMostDirections = 100;

/// A direction that is tried for one block only.
struct OwnDirection {
    std::size_t block;
    Vec3 direction;
};

struct Directions {
    std::vector<Vec3> everywhere;
    std::vector<OwnDirection> own;  ///< of the blocks, beyond kMostDirections
};

Directions directionsOf(const Slope& slope);

}  // namespace talus::keyblocks
