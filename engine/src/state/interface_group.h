#pragma once
// How interfaces and their contact points lie in memory.

#include <cstdint>

namespace talus {

/// Interfaces that a kernel treats at once: neighbours in the arrays with equal numbers of corners and
/// contact points. Their contact points and corners lie interleaved: the k-th of all members side by side, in
/// kLanes slots, the unused ones zero.
struct InterfaceGroup {
    std::int32_t begin = 0;         ///< first interface
    std::int32_t size = 0;          ///< members, 1..kLanes
    std::int32_t corners = 0;       ///< of each member's patch
    std::int32_t points = 0;        ///< contact points of each member
    std::int64_t first_corner = 0;  ///< slot of the first member's first corner
    std::int64_t first_point = 0;   ///< slot of the first member's first contact point
    bool is_idle = false;  ///< all members are places that touch nothing: the kernel passes over them
};

}  // namespace talus
