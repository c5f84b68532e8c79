#pragma once
// Boxes in a tree of halves: which of many things may meet one.

#include <algorithm>
#include <numeric>
#include <vector>

#include "talus/polyhedron.h"

namespace talus::rock_mass {

struct Box {
    Vec3 min = Vec3::Constant(1e300), max = Vec3::Constant(-1e300);  ///< [m]

    void add(const Vec3& point) {
        min = min.cwiseMin(point);
        max = max.cwiseMax(point);
    }
    void add(const Box& other) {
        min = min.cwiseMin(other.min);
        max = max.cwiseMax(other.max);
    }
    bool meets(const Box& other) const {
        return (min.array() <= other.max.array()).all() && (other.min.array() <= max.array()).all();
    }
};

class BoxTree {
 public:
    explicit BoxTree(const std::vector<Box>& boxes) : boxes_(boxes), order_(boxes.size()) {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        if (!boxes.empty()) build(0, boxes.size());
    }

    /// Calls `use(index)` for every box that meets this one.
    template <class Use>
    void visit(const Box& box, const Use& use) const {
        if (nodes_.empty()) return;
        std::vector<std::size_t> todo{0};
        while (!todo.empty()) {
            const Node& node = nodes_[todo.back()];
            todo.pop_back();
            if (!node.box.meets(box)) continue;
            if (node.second == 0) {
                for (std::size_t k = node.begin; k < node.end; ++k)
                    if (boxes_[order_[k]].meets(box)) use(order_[k]);
                continue;
            }
            todo.push_back(node.second);
            todo.push_back(static_cast<std::size_t>(&node - nodes_.data()) + 1);
        }
    }

 private:
    struct Node {
        Box box;
        std::size_t begin, end, second;  ///< the first child is the next node; second: 0 of a leaf
    };
    static constexpr std::size_t kLeaf = 8;

    std::size_t build(std::size_t begin, std::size_t end) {
        const std::size_t at = nodes_.size();
        nodes_.push_back({{}, begin, end, 0});
        Box box;
        for (std::size_t k = begin; k < end; ++k) box.add(boxes_[order_[k]]);
        nodes_[at].box = box;
        if (end - begin <= kLeaf) return at;
        Eigen::Index axis = 0;
        (box.max - box.min).maxCoeff(&axis);
        const std::size_t middle = begin + (end - begin) / 2;
        const auto key = [&](std::size_t b) { return boxes_[b].min[axis] + boxes_[b].max[axis]; };
        std::nth_element(
            order_.begin() + static_cast<std::ptrdiff_t>(begin),
            order_.begin() + static_cast<std::ptrdiff_t>(middle),
            order_.begin() + static_cast<std::ptrdiff_t>(end),
            [&](std::size_t a, std::size_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
        build(begin, middle);
        nodes_[at].second = build(middle, end);
        return at;
    }

    const std::vector<Box>& boxes_;
    std::vector<std::size_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace talus::rock_mass
