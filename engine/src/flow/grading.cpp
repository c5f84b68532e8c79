#include "flow/grading.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "flow/places.h"

namespace talus::flow {
namespace {

// Of a side, from its ends: a side is divided at an outline that crosses between. bench/studies/drain-in-a-joint.md
// has what half and nearly twice do.
constexpr double kMiddle = 0.25;

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
    }

 private:
    const Vec3& at(std::int32_t node) const { return network_.nodes[static_cast<std::size_t>(node)]; }
    double length(const Side& side) const { return (at(side.second) - at(side.first)).norm(); }

    /// Of sides of one length, the one of later nodes: an order of all sides, so that `divide` ends.
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
        const double side = length(longest(t));
        const std::array corners{network_.corner(t, 0), network_.corner(t, 1), network_.corner(t, 2)};
        return std::ranges::any_of(footprints(t), [&](const Footprint* footprint) {
            return side > footprint->size && side > mostSide(*footprint, corners);  // the first is quick
        });
    }

    /// Divides its longest side. Neighbours that have a longer one there are divided first.
    void divide(std::size_t t) {
        const Side divided = longest(t);
        const auto other = std::ranges::find_if(
            triangles_on_[divided], [&](std::size_t neighbour) { return longest(neighbour) != divided; });
        if (other != triangles_on_[divided].end()) return divide(*other);
        const auto node = static_cast<std::int32_t>(network_.nodes.size());
        network_.nodes.push_back(placeOn(divided));
        const std::vector<std::size_t> meet = std::exchange(triangles_on_[divided], {});
        triangles_on_.erase(divided);
        for (const std::size_t each : meet) split(each, divided, node);
    }

    /// The middle, or where an outline crosses near it.
    Vec3 placeOn(const Side& divided) const {
        const Vec3 &begin = at(divided.first), &end = at(divided.second);
        double share = 0.5, off = 0.5 - kMiddle;
        for (const std::size_t t : triangles_on_.at(divided))
            for (const Footprint* footprint : footprints(t)) {
                const Stretch in = stretchInBox(begin, end, footprint->low, footprint->high);
                if (in.from > in.to) continue;
                for (const double place : {in.from, in.to})
                    if (std::abs(place - 0.5) < off) share = place, off = std::abs(place - 0.5);
            }
        return (1 - share) * begin + share * end;
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
    Network sorted = network;
    for (std::size_t t = 0; t < order.size(); ++t) {
        sorted.triangles[t] = network.triangles[order[t]];
        sorted.patch_of[t] = network.patch_of[order[t]];
    }
    network = std::move(sorted);
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
