#pragma once
// The blocks that must move with a block along a direction. A block is stopped by every neighbour it would
// press into, so that neighbour must move, too, and so on. All blocks reached in this graph are its closure
// and move with it. A closure with a fixed block does not move.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "block_theory/slope.h"
#include "block_theory/tolerances.h"

namespace talus::keyblocks {

/// Some blocks of a slope, with marks that cost nothing to clear.
class Marks {
 public:
    explicit Marks(std::size_t blocks) : at_(blocks, 0) {}
    void clear() { ++now_; }
    bool has(std::size_t block) const { return at_[block] == now_; }
    /// \return whether it had no mark
    bool mark(std::size_t block) {
        if (has(block)) return false;
        at_[block] = now_;
        return true;
    }
    /// \return whether it had a mark
    bool unmark(std::size_t block) {
        if (!has(block)) return false;
        at_[block] = 0;
        return true;
    }

 private:
    std::vector<std::uint32_t> at_;
    std::uint32_t now_ = 1;
};

/// Whether, along a direction, the block beyond a contact stops the block the normal points into; and the
/// reverse, with the opposite normal.
inline bool stops(const Contact& contact, const Vec3& direction) {
    return contact.normal.dot(direction) < -kInTheWay;
}
inline bool isStoppedBeyond(const Contact& contact, const Vec3& direction) {
    return contact.normal.dot(direction) > kInTheWay;
}

/// Adds to `members`, and marks, the blocks that must move with the members from `first` on.
/// \return false, and members are not complete: a held block stops them, or they are more than `most`
bool closeOver(const Slope& slope, const Vec3& direction, std::size_t first, std::size_t most, Marks& marks,
               std::vector<std::size_t>& members);

/// One block of each strongly connected component of the blocks that can move along a direction: blocks that
/// stop each other have the same closure. Components that must move with another one come before it (R. E.
/// Tarjan, SIAM J. Comput. 1: 146-160, 1972).
struct Movable {
    std::vector<std::size_t> seeds;
    std::vector<char> can_move;  ///< by block: no held block is in its closure
};
Movable movableAlong(const Slope& slope, const Vec3& direction);

}  // namespace talus::keyblocks
