#include "flow/grading.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "flow/places.h"

namespace talus::flow {
namespace {

class Grading {
 public:
    Grading(Network& network, std::span<const Footprint> footprints)
        : network_(network), footprints_(network.patches.size()) {
        for (const Footprint& footprint : footprints)
            footprints_[static_cast<std::size_t>(footprint.patch)].push_back(&footprint);
        for (std::size_t t = 0; t < network_.triangles.size(); ++t) enter(t);
    }

    void make() {
        for (std::size_t t = 0; t < network_.triangles.size(); ++t)
            while (isTooLarge(t)) divide(t);
        for (std::size_t t = 0; t < network_.triangles.size(); ++t)
            while (meetOutline(t)) {
            }
    }

 private:
    const Vec3& at(std::int32_t node) const { return network_.nodes[static_cast<std::size_t>(node)]; }
    double length(const Side& side) const { return (at(side.second) - at(side.first)).norm(); }

    /// Of sides of equal length, the one with the later nodes. This orders all sides, so that `divide` ends.
    Side longest(std::size_t t) const {
        Side most = network_.side(t, 0);
        for (const std::size_t k : {1U, 2U}) {
            const Side side = network_.side(t, k);
            if (std::pair(length(side), side) > std::pair(length(most), most)) most = side;
        }
        return most;
    }

    const std::vector<const Footprint*>& footprints(std::size_t t) const {
        return footprints_[static_cast<std::size_t>(network_.patch_of[t])];
    }

    bool isTooLarge(std::size_t t) const {
        const std::array corners{network_.corner(t, 0), network_.corner(t, 1), network_.corner(t, 2)};
        return std::ranges::any_of(
            footprints(t), [&](const Footprint* footprint) { return flow::isTooLarge(*footprint, corners); });
    }

    /// Halves its longest side. Neighbours that have a longer one there are divided first.
    void divide(std::size_t t) {
        const Side side = longest(t);
        const std::vector<std::size_t>& meet = triangles_on_[side];
        const auto other =
            std::ranges::find_if(meet, [&](std::size_t neighbour) { return longest(neighbour) != side; });
        if (other != meet.end()) return divide(*other);
        divide(side, 0.5 * (at(side.first) + at(side.second)));
    }

    /// Divides a side where an outline crosses it. A flat triangle has its corners on one line, and an outline
    /// that crosses one side there meets the next at a corner. \return whether a side was divided
    bool meetOutline(std::size_t t) {
        if (isFlat(t)) return false;
        for (const Footprint* footprint : footprints(t))
            for (std::size_t k = 0; k < 3; ++k) {
                const Side side = network_.side(t, k);
                const auto place = crossing(*footprint, at(side.first), at(side.second));
                if (!place) continue;
                divide(side, *place);
                return true;
            }
        return false;
    }

    bool isFlat(std::size_t t) const {
        const Vec3 a = network_.corner(t, 1) - network_.corner(t, 0),
                   b = network_.corner(t, 2) - network_.corner(t, 0);
        return a.cross(b).norm() <= kNear * network_.size * length(longest(t));
    }

    void divide(const Side& side, const Vec3& place) {
        const auto node = static_cast<std::int32_t>(network_.nodes.size());
        network_.nodes.push_back(place);
        const std::vector<std::size_t> meet = std::exchange(triangles_on_[side], {});
        triangles_on_.erase(side);
        for (const std::size_t each : meet) split(each, side, node);
    }

    void split(std::size_t t, const Side& divided, std::int32_t node) {
        std::size_t k = 0;
        while (network_.side(t, k) != divided) ++k;
        leave(t);
        const auto corners = network_.triangles[t];
        const std::int32_t a = corners[k], b = corners[(k + 1) % 3], apex = corners[(k + 2) % 3];
        network_.triangles[t] = {a, node, apex};
        enter(t);
        network_.triangles.push_back({node, b, apex});
        network_.patch_of.push_back(network_.patch_of[t]);
        enter(network_.triangles.size() - 1);
    }

    void enter(std::size_t t) {
        for (std::size_t k = 0; k < 3; ++k) triangles_on_[network_.side(t, k)].push_back(t);
    }
    void leave(std::size_t t) {
        for (std::size_t k = 0; k < 3; ++k)
            if (const auto found = triangles_on_.find(network_.side(t, k)); found != triangles_on_.end())
                std::erase(found->second, t);
    }

    Network& network_;
    std::vector<std::vector<const Footprint*>> footprints_;  ///< of each patch
    std::map<Side, std::vector<std::size_t>> triangles_on_;
};

void sortByPatch(Network& network) {
    std::vector<std::size_t> order(network.triangles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t t) { return network.patch_of[t]; });
    auto triangles = network.triangles;
    auto patch_of = network.patch_of;
    for (std::size_t t = 0; t < order.size(); ++t) {
        triangles[t] = network.triangles[order[t]];
        patch_of[t] = network.patch_of[order[t]];
    }
    network.triangles = std::move(triangles);
    network.patch_of = std::move(patch_of);
}

}  // namespace

std::vector<char> grade(Network& network, std::span<const Footprint> footprints) {
    std::vector<char> divided(network.patches.size(), 0);
    if (footprints.empty()) return divided;
    const std::size_t before = network.triangles.size();
    Grading(network, footprints).make();
    for (std::size_t t = before; t < network.triangles.size(); ++t)
        divided[static_cast<std::size_t>(network.patch_of[t])] = 1;
    sortByPatch(network);
    return divided;
}

}  // namespace talus::flow
