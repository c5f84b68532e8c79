#pragma once
// The weakest of many groups.

#include <algorithm>
#include <unordered_set>
#include <vector>

#include "block_theory/group.h"

namespace talus::keyblocks {

/// Keeps up to `most` groups, no two of the same blocks. A group within another of equal factor is left out:
/// the larger one fails as a whole. Otherwise a slope on one bed would fill the list with its parts.
class BestGroups {
 public:
    explicit BestGroups(std::size_t most) : most_(most) {}

    /// Whether it may be among the best.
    bool wants(const Group& group) const {
        return group.sliding.mode != SlidingMode::none && !(is_full_ && isBefore(groups_[most_ - 1], group));
    }
    void add(Group&& group) {
        if (groups_.size() >= 2 * most_) cut();
        if (!wants(group)) return;
        std::sort(group.members.begin(), group.members.end());
        groups_.push_back(std::move(group));
    }
    void add(BestGroups&& others) {
        for (Group& group : others.groups_) add(std::move(group));
        others.groups_.clear();
    }
    /// The best `most`, in order.
    const std::vector<Group>& sorted() {
        cut();
        return groups_;
    }
    std::vector<Group> take() {
        cut();
        return std::move(groups_);
    }

 private:
    void cut() {
        std::stable_sort(groups_.begin(), groups_.end(), isBefore);
        std::unordered_set<std::uint64_t> known;
        std::vector<Group> kept;
        std::size_t first_equal = 0;
        for (Group& group : groups_) {
            if (!known.insert(group.identity).second) continue;
            if (!kept.empty() && !haveEqualFactors(kept.back(), group)) first_equal = kept.size();
            const bool is_part =
                std::any_of(kept.begin() + static_cast<std::ptrdiff_t>(first_equal), kept.end(),
                            [&](const Group& larger) {
                                return larger.carried.empty() == group.carried.empty() &&
                                       std::includes(larger.members.begin(), larger.members.end(),
                                                     group.members.begin(), group.members.end());
                            });
            if (is_part) continue;
            if (kept.size() == most_) break;
            kept.push_back(std::move(group));
        }
        groups_ = std::move(kept);
        is_full_ = groups_.size() == most_;
    }

    std::size_t most_;
    /// The first `most` of groups_ are in order, and others have to be better than the last of them.
    bool is_full_ = false;
    std::vector<Group> groups_;
};

}  // namespace talus::keyblocks
