#pragma once
// A group of blocks, and which of two is the weaker.

#include <cstdint>
#include <vector>

#include "block_theory/judge.h"

namespace talus::keyblocks {

/// Free blocks that move as one.
struct Group {
    std::vector<std::size_t> members;
    Sliding sliding;             ///< without planes and joints
    double mass = 0;             ///< [kg]
    double volume = 0;           ///< [m^3]
    std::uint64_t identity = 0;  ///< a hash of the members, whatever their order
    /// Blocks that it carries (BodyMaker::settled) and that cannot move with it.
    std::vector<std::size_t> carried{};
};

/// Smaller factor first; of equal ones (to rounding) the heavier first, so that an answer names all blocks
/// that fail at it.
bool isBefore(const Group& a, const Group& b);
bool haveEqualFactors(const Group& a, const Group& b);

}  // namespace talus::keyblocks
