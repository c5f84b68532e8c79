#include "block_theory/closures.h"

#include <algorithm>

namespace talus::keyblocks {
namespace {

/// From fixed blocks backwards: the blocks they stop, and the blocks those stop.
std::vector<char> movableBlocks(const Slope& slope, const Vec3& direction) {
    std::vector<char> can_move = slope.free;
    std::vector<std::size_t> stopped;
    for (std::size_t b = 0; b < slope.size(); ++b)
        if (!slope.free[b]) stopped.push_back(b);
    while (!stopped.empty()) {
        const std::size_t b = stopped.back();
        stopped.pop_back();
        for (const Contact& contact : slope.contactsOf(b)) {
            const auto other = static_cast<std::size_t>(contact.other);
            if (!can_move[other] || !isStoppedBeyond(contact, direction)) continue;
            can_move[other] = 0;
            stopped.push_back(other);
        }
    }
    return can_move;
}

/// Tarjan's algorithm without recursion: chains of blocks are as long as the slope is large.
class Components {
 public:
    Components(const Slope& slope, const Vec3& direction, const std::vector<char>& can_move)
        : slope_(slope), direction_(direction), number_(slope.size(), 0), low_(slope.size(), 0) {
        for (std::size_t b = 0; b < slope.size(); ++b)
            if (can_move[b] && number_[b] == 0) visit(b);
    }
    std::vector<std::size_t> take() { return std::move(firsts_); }

 private:
    static constexpr std::uint32_t kDone = ~std::uint32_t{0};
    struct Call {
        std::size_t block, next;  ///< of its contacts
    };

    void begin(std::size_t block) {
        number_[block] = low_[block] = ++count_;
        open_.push_back(block);
        calls_.push_back({block, slope_.begin[block]});
    }

    void visit(std::size_t root) {
        begin(root);
        while (!calls_.empty()) {
            const std::size_t block = calls_.back().block;
            if (calls_.back().next < slope_.begin[block + 1]) {
                follow(block, slope_.contacts[calls_.back().next++]);
                continue;
            }
            calls_.pop_back();
            if (!calls_.empty()) lower(calls_.back().block, low_[block]);
            if (low_[block] == number_[block]) close(block);
        }
    }

    /// A block that stops a movable block can move itself.
    void follow(std::size_t block, const Contact& contact) {
        if (!stops(contact, direction_)) return;
        const auto other = static_cast<std::size_t>(contact.other);
        if (number_[other] == 0)
            begin(other);
        else if (number_[other] != kDone)
            lower(block, number_[other]);
    }

    void lower(std::size_t block, std::uint32_t to) { low_[block] = std::min(low_[block], to); }

    void close(std::size_t first) {
        firsts_.push_back(first);
        std::size_t block;
        do {
            block = open_.back();
            open_.pop_back();
            number_[block] = kDone;
        } while (block != first);
    }

    const Slope& slope_;
    const Vec3& direction_;
    std::vector<std::uint32_t> number_, low_;
    std::uint32_t count_ = 0;
    std::vector<std::size_t> open_, firsts_;
    std::vector<Call> calls_;
};

}  // namespace

bool closeOver(const Slope& slope, const Vec3& direction, std::size_t first, std::size_t most, Marks& marks,
               std::vector<std::size_t>& members) {
    for (std::size_t k = first; k < members.size(); ++k) {
        for (const Contact& contact : slope.contactsOf(members[k])) {
            if (!stops(contact, direction)) continue;
            const auto other = static_cast<std::size_t>(contact.other);
            if (!slope.free[other]) return false;
            if (marks.mark(other)) members.push_back(other);
        }
        if (members.size() > most) return false;
    }
    return true;
}

Movable movableAlong(const Slope& slope, const Vec3& direction) {
    Movable movable;
    movable.can_move = movableBlocks(slope, direction);
    movable.seeds = Components(slope, direction, movable.can_move).take();
    return movable;
}

}  // namespace talus::keyblocks
