#include "flow/grading.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "flow/delaunay.h"

using namespace talus;
using talus::flow::Footprint;
using talus::flow::Network;

namespace {

/// Two squares of 8 m that meet at a right angle along y, and a third beyond: three at one edge.
Network threeAtAnEdge() {
    Network network;
    network.nodes = {{0, 0, 0},  {0, 8, 0},  {8, 0, 0}, {8, 8, 0},
                     {-8, 0, 0}, {-8, 8, 0}, {0, 0, 8}, {0, 8, 8}};
    network.triangles = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}, {0, 1, 7}, {0, 7, 6}};
    network.patch_of = {0, 0, 1, 1, 2, 2};
    network.patches.resize(3);
    return network;
}

/// In the first square.
Footprint drain(double x, double y, double width, double length) {
    const Vec2 low(x - width / 2, y - length / 2), high(x + width / 2, y + length / 2);
    return {0,
            {},
            {low, {high.x(), low.y()}, high, {low.x(), high.y()}},
            std::min(width, length) / 8,
            1e-6,
            {x, y, 0},
            (high - low).norm() / 2};
}

double longestSide(const Network& network, std::size_t t) {
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k)
        most = std::max(most, (network.corner(t, k) - network.corner(t, (k + 1) % 3)).norm());
    return most;
}

/// Twice the area along the normal, which is along z, -z or y of the three squares.
Vec3 areaOf(const Network& network, std::size_t t) {
    return (network.corner(t, 1) - network.corner(t, 0)).cross(network.corner(t, 2) - network.corner(t, 0));
}

using Sides = std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::size_t>>;

Sides sidesOf(const Network& network) {
    Sides sides;
    for (std::size_t t = 0; t < network.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            sides[std::minmax(network.triangles[t][k], network.triangles[t][(k + 1) % 3])].push_back(t);
    return sides;
}

/// Whether triangles cover the three squares once, and no node lies on a side.
void checkWhole(const Network& network) {
    const Network before = threeAtAnEdge();
    std::array<Vec3, 3> area{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    bool is_turned = false;
    for (std::size_t t = 0; t < network.triangles.size(); ++t) {
        const auto patch = static_cast<std::size_t>(network.patch_of[t]);
        is_turned |= areaOf(network, t).dot(areaOf(before, 2 * patch)) <= 0;
        area[patch] += areaOf(network, t);
    }
    CHECK_FALSE(is_turned);
    for (const Vec3& each : area) CHECK(each.norm() == doctest::Approx(2 * 64).epsilon(1e-12));
    CHECK(std::ranges::is_sorted(network.patch_of));
    int torn = 0;
    for (const auto& [nodes, triangles] : sidesOf(network)) {
        const Vec3 &a = network.nodes[static_cast<std::size_t>(nodes.first)],
                   &b = network.nodes[static_cast<std::size_t>(nodes.second)];
        const Vec3 middle = 0.5 * (a + b);
        const bool on_rim =
            std::abs(middle.x()) == 8 || middle.y() == 0 || middle.y() == 8 || middle.z() == 8;
        const bool at_crossing = a.x() == 0 && b.x() == 0 && a.z() == 0 && b.z() == 0;
        if (triangles.size() != (at_crossing ? 3U : on_rim ? 1U : 2U)) ++torn;
    }
    CHECK(torn == 0);
}

double cotangentAcross(const Network& network, std::size_t t, std::pair<std::int32_t, std::int32_t> side) {
    std::size_t k = 0;
    while (network.triangles[t][k] == side.first || network.triangles[t][k] == side.second) ++k;
    const Vec3 a = network.corner(t, (k + 1) % 3) - network.corner(t, k),
               b = network.corner(t, (k + 2) % 3) - network.corner(t, k);
    return a.dot(b) / a.cross(b).norm();
}

}  // namespace

TEST_CASE("grading: fine on the outline of a drain, coarse far away, and no node on a side") {
    for (const Footprint& footprint :
         {drain(3, 5, 0.4, 0.4), drain(7.9, 0.1, 0.4, 0.4), drain(4, 4, 0.08, 3), drain(0.1, 4, 0.3, 0.3)}) {
        Network network = threeAtAnEdge();
        const std::vector<char> divided = flow::grade(network, std::array{footprint});
        CHECK(divided[0] == 1);
        checkWhole(network);
        double coarsest = 0;
        int large = 0;
        for (std::size_t t = 0; t < network.triangles.size(); ++t) {
            coarsest = std::max(coarsest, longestSide(network, t));
            const std::array corners{network.corner(t, 0), network.corner(t, 1), network.corner(t, 2)};
            if (network.patch_of[t] == 0 && flow::isTooLarge(footprint, corners)) ++large;
            for (std::size_t k = 0; k < 3; ++k)
                if (network.patch_of[t] == 0 && flow::crossing(footprint, corners[k], corners[(k + 1) % 3]))
                    ++large;
        }
        CHECK(large == 0);
        CHECK(coarsest > 1.5);
        flow::makeDelaunay(network, divided, std::array{footprint});
        checkWhole(network);
        double least = 0;
        for (const auto& [side, on] : sidesOf(network)) {
            if (on.size() != 2 || network.patch_of[on[0]] != network.patch_of[on[1]]) continue;
            if (divided[static_cast<std::size_t>(network.patch_of[on[0]])] == 0) continue;
            const auto at = [&](std::int32_t node) { return network.nodes[static_cast<std::size_t>(node)]; };
            if (network.patch_of[on[0]] == 0 && flow::isOnOutline(footprint, at(side.first), at(side.second)))
                continue;
            least = std::min(least,
                             cotangentAcross(network, on[0], side) + cotangentAcross(network, on[1], side));
        }
        CHECK(least > -1e-8);
    }
}

TEST_CASE("grading: without footprints the mesh stays as it is") {
    Network network = threeAtAnEdge();
    CHECK(flow::grade(network, {}) == std::vector<char>(3, 0));
    flow::makeDelaunay(network, {0, 0, 0}, {});
    CHECK(network.triangles == threeAtAnEdge().triangles);
}
