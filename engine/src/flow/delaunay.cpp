#include "flow/delaunay.h"

#include <algorithm>
#include <map>
#include <utility>

namespace talus::flow {
namespace {

// Of the cotangents opposite a side, added: a side so little too long stays, and turns do not go round.
constexpr double kRounding = 1e-9;

class Turning {
 public:
    Turning(Network& network, const std::vector<char>& patches, std::span<const Footprint> footprints)
        : network_(network), footprints_(network.patches.size()) {
        for (const Footprint& footprint : footprints)
            footprints_[static_cast<std::size_t>(footprint.patch)].push_back(&footprint);
        for (std::size_t t = 0; t < network.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) triangles_on_[network_.side(t, k)].push_back(t);
            if (patches[static_cast<std::size_t>(network.patch_of[t])] != 0)
                for (std::size_t k = 0; k < 3; ++k) left_.push_back(network_.side(t, k));
        }
    }

    void make() {
        while (!left_.empty()) {
            const Side side = left_.back();
            left_.pop_back();
            if (isWrong(side)) turn(side);
        }
    }

 private:
    std::size_t cornerAcross(std::size_t t, const Side& side) const {
        std::size_t k = 0;
        while (network_.side(t, k) != side) ++k;
        return (k + 2) % 3;
    }
    double cotangentAcross(std::size_t t, const Side& side) const {
        const std::size_t k = cornerAcross(t, side);
        const Vec3 a = network_.corner(t, (k + 1) % 3) - network_.corner(t, k),
                   b = network_.corner(t, (k + 2) % 3) - network_.corner(t, k);
        return a.dot(b) / a.cross(b).norm();
    }

    bool isWrong(const Side& side) const {
        const auto found = triangles_on_.find(side);
        if (found == triangles_on_.end() || found->second.size() != 2) return false;
        const auto [s, t] = std::pair(found->second[0], found->second[1]);
        return network_.patch_of[s] == network_.patch_of[t] &&
               cotangentAcross(s, side) + cotangentAcross(t, side) < -kRounding && !isOfBoundary(s, side);
    }

    bool isOfBoundary(std::size_t t, const Side& side) const {
        const auto at = [&](std::int32_t node) -> const Vec3& {
            return network_.nodes[static_cast<std::size_t>(node)];
        };
        return std::ranges::any_of(footprints_[static_cast<std::size_t>(network_.patch_of[t])],
                                   [&](const Footprint* footprint) {
                                       return isOnOutline(*footprint, at(side.first), at(side.second));
                                   });
    }

    /// Of the two ways to halve a quadrangle, to the other one.
    void turn(const Side& side) {
        const std::vector<std::size_t> both = triangles_on_.at(side);
        triangles_on_.erase(side);
        const std::size_t s = both[0], t = both[1], k = cornerAcross(s, side), l = cornerAcross(t, side);
        const auto of_s = network_.triangles[s], of_t = network_.triangles[t];
        const std::int32_t apex_s = of_s[k], from = of_s[(k + 1) % 3], to = of_s[(k + 2) % 3],
                           apex_t = of_t[l];
        network_.triangles[s] = {apex_s, from, apex_t};
        network_.triangles[t] = {apex_t, to, apex_s};
        replace(std::minmax({from, apex_t}), t, s);
        replace(std::minmax({to, apex_s}), s, t);
        triangles_on_[std::minmax({apex_s, apex_t})] = both;
        for (const std::size_t each : both)
            for (std::size_t corner = 0; corner < 3; ++corner) left_.push_back(network_.side(each, corner));
    }

    void replace(const Side& on, std::size_t before, std::size_t now) {
        std::ranges::replace(triangles_on_.at(on), before, now);
    }

    Network& network_;
    std::vector<std::vector<const Footprint*>> footprints_;  ///< of each patch
    std::map<Side, std::vector<std::size_t>> triangles_on_;
    std::vector<Side> left_;
};

}  // namespace

void makeDelaunay(Network& network, const std::vector<char>& patches, std::span<const Footprint> footprints) {
    if (std::ranges::find(patches, 1) != patches.end()) Turning(network, patches, footprints).make();
}

}  // namespace talus::flow
