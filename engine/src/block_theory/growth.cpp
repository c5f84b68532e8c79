#include "block_theory/growth.h"

#include <optional>

namespace talus::keyblocks {
namespace {

using Blocks = std::vector<std::size_t>;

class Growth {
 public:
    Growth(const Slope& slope, std::size_t visits, BodyMaker& maker)
        : slope_(slope), visits_(visits), maker_(maker), marks_(slope.size()) {}

    /// Nothing where no group is weaker, or as weak and heavier, or where visits are used up.
    std::optional<Group> next(const Group& group) {
        Group best = larger(group);
        if (best.identity == group.identity) best = smaller(group);
        if (best.identity == group.identity) return std::nullopt;
        return best;
    }

 private:
    /// The best of the groups with more blocks, or the group itself.
    Group larger(const Group& group) {
        Group best = group;
        const auto look = [&](const Blocks& more) {
            std::optional<Group> with = joined(group, more);
            if (with) with = better(std::move(*with), group);
            if (!with) return false;
            if (isBefore(*with, best)) best = std::move(*with);
            return true;
        };
        maker_.groupOf(group.members);
        const Blocks neighbours = maker_.neighboursOf(group.members);
        look(neighbours);
        Blocks weakening;
        for (const std::size_t neighbour : neighbours)
            if (look({neighbour})) weakening.push_back(neighbour);
        if (weakening.size() > 1 && weakening.size() < neighbours.size()) look(weakening);
        return best;
    }

    /// The best of the groups with fewer blocks, or the group itself.
    Group smaller(const Group& group) {
        Group best = group;
        for (const std::size_t member : group.members) {
            if (!affords(2 * group.members.size())) break;
            for (const Blocks& piece : piecesWithout(group, member))
                if (auto left = better(maker_.groupOf(piece), best)) best = std::move(*left);
        }
        return best;
    }

    /// A group with all that it carries, if that is better than another group.
    std::optional<Group> better(Group group, const Group& than) {
        if (group.sliding.mode == SlidingMode::none || !isBefore(group, than)) return std::nullopt;
        if (!affords(2 * group.members.size())) return std::nullopt;
        group = maker_.settled(std::move(group));
        if (group.sliding.mode == SlidingMode::none) return std::nullopt;
        if (!group.carried.empty() || !isBefore(group, than)) return std::nullopt;
        return group;
    }

    /// Whether so many blocks may still be looked at; they count as looked at then.
    bool affords(std::size_t blocks) {
        if (blocks > visits_) return false;
        visits_ -= blocks;
        return true;
    }

    /// The group with these blocks, and what has to move with them; nothing where that cannot move.
    std::optional<Group> joined(const Group& group, const Blocks& more) {
        if (more.empty() || !affords(2 * group.members.size() + more.size())) return std::nullopt;
        marks_.clear();
        Blocks members = group.members;
        for (const std::size_t block : members) marks_.mark(block);
        for (const std::size_t block : more)
            if (marks_.mark(block)) members.push_back(block);
        if (!closeOver(slope_, group.sliding.direction, group.members.size(), slope_.size(), marks_, members))
            return std::nullopt;
        Group with = maker_.groupOf(members);
        return with.sliding.mode == SlidingMode::none ? std::nullopt : std::optional(std::move(with));
    }

    /// What is left of a group once a member is held, in pieces that hang together.
    std::vector<Blocks> piecesWithout(const Group& group, std::size_t member) {
        Marks& inside = marks_;
        inside.clear();
        for (const std::size_t block : group.members) inside.mark(block);
        Blocks held{member};
        inside.unmark(member);
        for (std::size_t k = 0; k < held.size(); ++k)
            for (const Contact& contact : slope_.contactsOf(held[k]))
                if (isStoppedBeyond(contact, group.sliding.direction) &&
                    inside.unmark(static_cast<std::size_t>(contact.other)))
                    held.push_back(static_cast<std::size_t>(contact.other));
        std::vector<Blocks> pieces;
        for (const std::size_t first : group.members) {
            if (!inside.unmark(first)) continue;
            Blocks piece{first};
            for (std::size_t k = 0; k < piece.size(); ++k)
                for (const Contact& contact : slope_.contactsOf(piece[k]))
                    if (inside.unmark(static_cast<std::size_t>(contact.other)))
                        piece.push_back(static_cast<std::size_t>(contact.other));
            pieces.push_back(std::move(piece));
        }
        return pieces;
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
