#pragma once
// The weakest of many groups by their volume: the factor of failures of at least some volume.

#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include "block_theory/group.h"

namespace talus::keyblocks {

/// Keeps a group if no other has at least its volume and at most its factor (a Pareto front). Both rise along
/// it, so the first group of at least some volume is the weakest of that volume. Of two equal groups the
/// first one added stays.
class VolumeFront {
 public:
    /// Whether no kept group has at least its volume and at most its factor.
    bool wants(const Group& group) const {
        if (group.sliding.mode == SlidingMode::none) return false;
        const auto larger = groups_.lower_bound(keyOf(group));
        return larger == groups_.end() || isWeaker(group, larger->second);
    }
    void add(Group group) {
        if (!wants(group)) return;
        auto behind = groups_.upper_bound(keyOf(group));
        while (behind != groups_.begin() && !isWeaker(std::prev(behind)->second, group))
            behind = groups_.erase(std::prev(behind));
        const float volume = keyOf(group);
        groups_.emplace_hint(behind, volume, std::move(group));
    }
    void add(VolumeFront&& others) {
        for (auto& [volume, group] : others.groups_) add(std::move(group));
        others.groups_.clear();
    }
    /// By volume, ascending.
    std::vector<Group> take() {
        std::vector<Group> groups;
        for (auto& [volume, group] : groups_) groups.push_back(std::move(group));
        groups_.clear();
        return groups;
    }

 private:
    /// Volumes that differ by rounding alone count as equal.
    static float keyOf(const Group& group) { return static_cast<float>(group.volume); }
    /// By more than rounding.
    static bool isWeaker(const Group& a, const Group& b) {
        return !haveEqualFactors(a, b) && a.sliding.factor < b.sliding.factor;
    }

    std::map<float, Group> groups_;
};

}  // namespace talus::keyblocks
