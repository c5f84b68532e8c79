#pragma once
// The directions along which groups of blocks are sought. Planes and pairs of planes give too many, so their
// number is bounded. Along each some body can slide under the present forces.

#include <vector>

#include "block_theory/slope.h"

namespace talus::keyblocks {

/// The plane with the most contact area represents all within kSameSet of it; then the next. Up to kMostSets
/// such planes give their dip directions and their lines of intersection. Joint sets of a slope are three or
/// four.
inline constexpr double kSameSet = 0.17453292519943295;  ///< 10 degrees [rad]
inline constexpr std::size_t kMostSets = 8;

/// Directions that are tried for every block. Those of the sets come first. Then come the blocks' own, most
/// mass first: dip directions of the planes they press, and lines of intersection of two. Each costs a pass
/// over all contacts.
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
