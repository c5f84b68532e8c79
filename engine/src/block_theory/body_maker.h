#pragma once
// Blocks joined to one body.

#include <cstdint>
#include <limits>
#include <unordered_set>
#include <utility>
#include <vector>

#include "block_theory/closures.h"
#include "block_theory/group.h"

namespace talus::keyblocks {

/// One for each thread: it has arrays as long as the slope.
class BodyMaker {
 public:
    BodyMaker(const Slope& slope, const std::vector<Joint>& joints)
        : slope_(slope), joints_(joints), inside_(slope.size()), seen_(slope.size()) {}

    /// As one body; all others are fixed.
    Group groupOf(const std::vector<std::size_t>& members);
    /// The same with planes and joints.
    Sliding detailsOf(const std::vector<std::size_t>& members);
    /// Free blocks that touch it, each once. \param members  as of the last call of one of the two above
    std::vector<std::size_t> neighboursOf(const std::vector<std::size_t>& members);

    /// A group's factor assumes that no other block presses on it. That holds only if the others are stable
    /// without it, at strengths divided by that factor. A neighbour that leans on the group and would fail
    /// without it (its own factor is less) is carried. It joins the group with all that must move with it,
    /// the least factor first, until nothing more is carried. Otherwise the lowest row of a stack would slide
    /// from under the others as if they had no weight. Carried blocks that cannot move are kept in `carried`.
    /// The result has no motion if the allowed work is used up, or if it reaches a group in `known`, which
    /// was settled before. Groups on the way are added to `known`.
    Group settled(Group group, std::unordered_set<std::uint64_t>* known = nullptr);
    /// Neighbours and members that `settled` may look at from now on.
    void allow(std::size_t work) { work_left_ = work; }
    bool isUsedUp() const { return work_left_ == 0; }

    static std::uint64_t identityOf(const std::vector<std::size_t>& members);

 private:
    Body bodyOf(const std::vector<std::size_t>& members);
    /// Block, and its factor without the group.
    using Carried = std::vector<std::pair<std::size_t, double>>;
    Carried carriedBy(const Group& group);
    bool leansOnInside(std::size_t block) const;
    /// Against all blocks outside the body of the last `bodyOf`.
    double factorWithoutInside(std::size_t block);

    const Slope& slope_;
    const std::vector<Joint>& joints_;
    Marks inside_, seen_;
    std::vector<Contact> outer_{};
    std::size_t work_left_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace talus::keyblocks
