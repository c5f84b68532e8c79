#pragma once
// The solids as leaves of the tree of cuts. A node's box holds all that was cut from it, so a plane visits
// only the solids that it may meet, and the nodes above them.

#include <vector>

#include "rock_mass/solid.h"

namespace talus::rock_mass {

class CutTree {
 public:
    explicit CutTree(std::vector<Solid> solids);

    /// Calls `cut(solid)` for each leaf that a plane may meet (its finite joint `reach`, if there is one). It
    /// returns the parts that replace the solid, none to keep it.
    template <class Cut>
    void visit(const Plane& plane, const Reach* reach, double weld, const Cut& cut);

    std::size_t size() const { return solids_.size(); }
    const std::vector<Solid>& solids() const { return solids_; }

 private:
    struct Node {
        Vec3 min, max;
        std::int32_t first_child = -1;  ///< children are consecutive
        std::int32_t children = 0;
        std::int32_t solid = -1;  ///< of a leaf
    };

    static bool mayMeet(const Node& node, const Plane& plane, const Reach* reach, double weld);
    void addLeaf(Solid solid, std::int32_t slot);
    void replace(std::int32_t node, std::vector<Solid> parts);

    std::vector<Node> nodes_;
    std::vector<Solid> solids_;
};

inline CutTree::CutTree(std::vector<Solid> solids) {
    Node root{solids[0].min, solids[0].max, 1, static_cast<std::int32_t>(solids.size())};
    nodes_.push_back(root);
    for (Solid& solid : solids) {
        nodes_[0].min = nodes_[0].min.cwiseMin(solid.min);
        nodes_[0].max = nodes_[0].max.cwiseMax(solid.max);
        addLeaf(std::move(solid), -1);
    }
}

inline bool CutTree::mayMeet(const Node& node, const Plane& plane, const Reach* reach, double weld) {
    if (reach && ((node.min.array() > reach->max.array() + weld).any() ||
                  (node.max.array() < reach->min.array() - weld).any()))
        return false;
    const Vec3 half = 0.5 * (node.max - node.min);
    return std::abs(plane.height(node.min + half)) <= plane.normal.cwiseAbs().dot(half) + weld;
}

/// Into the slot of a removed solid, or a new one.
inline void CutTree::addLeaf(Solid solid, std::int32_t slot) {
    Node leaf{solid.min, solid.max};
    leaf.solid = slot >= 0 ? slot : static_cast<std::int32_t>(solids_.size());
    nodes_.push_back(leaf);
    if (slot >= 0)
        solids_[static_cast<std::size_t>(slot)] = std::move(solid);
    else
        solids_.push_back(std::move(solid));
}

inline void CutTree::replace(std::int32_t node, std::vector<Solid> parts) {
    std::int32_t slot = nodes_[static_cast<std::size_t>(node)].solid;
    nodes_[static_cast<std::size_t>(node)].solid = -1;
    nodes_[static_cast<std::size_t>(node)].first_child = static_cast<std::int32_t>(nodes_.size());
    nodes_[static_cast<std::size_t>(node)].children = static_cast<std::int32_t>(parts.size());
    for (Solid& part : parts) {
        addLeaf(std::move(part), slot);
        slot = -1;
    }
}

template <class Cut>
void CutTree::visit(const Plane& plane, const Reach* reach, double weld, const Cut& cut) {
    std::vector<std::int32_t> todo{0};
    while (!todo.empty()) {
        const std::int32_t at = todo.back();
        todo.pop_back();
        const Node& node = nodes_[static_cast<std::size_t>(at)];
        if (!mayMeet(node, plane, reach, weld)) continue;
        for (std::int32_t c = node.children; c-- > 0;) todo.push_back(node.first_child + c);
        if (node.solid < 0) continue;
        std::vector<Solid> parts = cut(solids_[static_cast<std::size_t>(node.solid)]);
        if (!parts.empty()) replace(at, std::move(parts));
    }
}

}  // namespace talus::rock_mass
