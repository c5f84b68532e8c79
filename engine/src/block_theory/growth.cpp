#include "block_theory/growth.h"

#include <optional>

namespace talus::keyblocks {
namespace {

using Blocks = std::vector<std::size_t>;

class Growth {
 public:
    Growth(const Slope& slope, std::size_t visits, BodyMaker& maker)
        : slope_(slope), visits_(visits), maker_(maker), marks_(slope.size()) {}

    /// Nothing where none is weaker, or as weak and heavier, or visits are used up.
    std::optional<Group> next(const Group& group) {
        Group best = group;
        const auto look = [&](const Blocks& more) {
            std::optional<Group> larger = with(group, more);
            const bool no_stronger = larger && isBefore(*larger, group);
            if (larger && isBefore(*larger, best)) best = std::move(*larger);
            return no_stronger;
        };
        maker_.groupOf(group.members);
        const Blocks neighbours = maker_.neighboursOf(group.members);
        look(neighbours);
        Blocks weakening;
        for (const std::size_t neighbour : neighbours)
            if (look({neighbour})) weakening.push_back(neighbour);
        if (weakening.size() > 1 && weakening.size() < neighbours.size()) look(weakening);
        if (best.identity == group.identity) return std::nullopt;
        return best;
    }

 private:
    /// The group with these blocks, and what has to move with them; nothing where that cannot move.
    std::optional<Group> with(const Group& group, const Blocks& more) {
        if (more.empty() || 2 * group.members.size() + more.size() > visits_) return std::nullopt;
        marks_.clear();
        Blocks members = group.members;
        for (const std::size_t block : members) marks_.mark(block);
        for (const std::size_t block : more)
            if (marks_.mark(block)) members.push_back(block);
        const bool moves =
            closeOver(slope_, group.sliding.direction, group.members.size(), slope_.size(), marks_, members);
        visits_ -= std::min(visits_, 2 * members.size());
        if (!moves) return std::nullopt;
        Group larger = maker_.groupOf(members);
        return larger.sliding.mode == SlidingMode::none ? std::nullopt : std::optional(std::move(larger));
    }

    const Slope& slope_;
    std::size_t visits_;
    BodyMaker& maker_;
    Marks marks_;
};

}  // namespace

void grow(const Slope& slope, const Group& from, std::size_t visits, BodyMaker& maker, BestGroups& found) {
    Growth growth(slope, visits, maker);
    for (std::optional<Group> group = growth.next(from); group; group = growth.next(*group))
        found.add(Group(*group));
}

}  // namespace talus::keyblocks
