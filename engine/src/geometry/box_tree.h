#pragma once
// A tree of boxes: finds which of many boxes may meet a given one.

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "talus/polyhedron.h"

namespace talus {

/// Along the axes; empty until something is added.
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
    /// Wider by so much on every side [m].
    Box grown(double margin) const { return {min.array() - margin, max.array() + margin}; }
    /// Touching counts.
    bool meets(const Box& other) const {
        return (min.array() <= other.max.array()).all() && (other.min.array() <= max.array()).all();
    }
};

class BoxTree {
 public:
    BoxTree() = default;
    explicit BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        if (!boxes_.empty()) build(0, boxes_.size());
    }

    const Box& operator[](std::size_t index) const { return boxes_[index]; }
    std::size_t size() const { return boxes_.size(); }

    /// Calls `use(index)` for every box that meets this one, in no order. \return how many boxes it was
    /// compared with
    template <class Use>
    std::size_t visit(const Box& box, const Use& use) const {
        if (nodes_.empty()) return 0;
        std::vector<std::size_t> todo{0};
        std::size_t compared = 0;
        while (!todo.empty()) {
            const Node& node = nodes_[todo.back()];
            todo.pop_back();
            ++compared;
            if (!node.box.meets(box)) continue;
            if (node.second == 0) {
                compared += node.end - node.begin;
                for (std::size_t k = node.begin; k < node.end; ++k)
                    if (boxes_[order_[k]].meets(box)) use(order_[k]);
                continue;
            }
            todo.push_back(node.second);
            todo.push_back(static_cast<std::size_t>(&node - nodes_.data()) + 1);
        }
        return compared;
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

    std::vector<Box> boxes_{};
    std::vector<std::size_t> order_{};
    std::vector<Node> nodes_{};
};

}  // namespace talus
