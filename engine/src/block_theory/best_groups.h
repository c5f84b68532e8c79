#pragma once
// The weakest of many groups.

#include <algorithm>
#include <unordered_set>
#include <vector>

#include "block_theory/groups.h"

namespace talus::keyblocks {

/// Keeps up to `most` groups, no two of the same blocks.
class BestGroups {
 public:
    explicit BestGroups(std::size_t most) : most_(most) {}

    void add(Group&& group) {
        if (group.sliding.mode == SlidingMode::none) return;
        if (groups_.size() >= 2 * most_) {
            cut();
            if (isBefore(groups_.back(), group)) return;
        }
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
        std::erase_if(groups_, [&](const Group& group) { return !known.insert(group.identity).second; });
        if (groups_.size() > most_) groups_.resize(most_);
    }

    std::size_t most_;
    std::vector<Group> groups_;
};

}  // namespace talus::keyblocks
