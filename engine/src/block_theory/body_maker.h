#pragma once
// Blocks put together to one body.

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

    /// As one body against all others, held still.
    Group groupOf(const std::vector<std::size_t>& members);
    /// The same with planes and joints.
    Sliding detailsOf(const std::vector<std::size_t>& members);
    /// Free blocks that touch it, each once. \param members  as of the last call of one of the two above
    std::vector<std::size_t> neighboursOf(const std::vector<std::size_t>& members);

    /// A group's factor takes it that the rest presses on it nowhere. That is so only if the rest stands
    /// without it, at strengths divided by that factor. A neighbour that leans on the group and does not
    /// stand so (its own factor without the group is less) is carried: it goes with the group, with what has
    /// to move with it, the one with the least factor first, until nothing more is carried. Else the lowest
    /// row of a stack would slide from under the others as if they had no weight. Where what is carried
    /// cannot move the group keeps it as `carried`. Nothing moves in what it gives where the work that is
    /// allowed is used up, or where it comes to a group that `known` has (it adds those on its way): that one
    /// was settled before.
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
    /// Against all that is not in the body of the last `bodyOf`.
    double factorWithoutInside(std::size_t block);

    const Slope& slope_;
    const std::vector<Joint>& joints_;
    Marks inside_, seen_;
    std::vector<Contact> outer_{};
    std::size_t work_left_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace talus::keyblocks
