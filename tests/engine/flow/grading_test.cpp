#include "flow/grading.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "flow/network.h"
using namespace talus;
using talus::flow::Network;

namespace {

/// Two squares of 8 m that meet at a right angle along y, and a third beyond: three at one edge.
Network threeAtAnEdge() {
    Network network;
    network.nodes = {{0, 0, 0},  {0, 8, 0},  {8, 0, 0}, {8, 8, 0},
                     {-8, 0, 0}, {-8, 8, 0}, {0, 0, 8}, {0, 8, 8}};
    network.triangles = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}, {0, 1, 7}, {0, 7, 6}};
    network.patch_of = {0, 0, 1, 1, 2, 2};
    return network;
}

double longestSide(const Network& network, std::size_t t) {
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k)
        most = std::max(most, (network.corner(t, k) - network.corner(t, (k + 1) % 3)).norm());
    return most;
}

double areaOf(const Network& network, std::size_t t) {
    return 0.5 * (network.corner(t, 1) - network.corner(t, 0))
                     .cross(network.corner(t, 2) - network.corner(t, 0))
                     .norm();
}

}  // namespace

TEST_CASE("grading: the mesh is fine at the corner, coarse far away, and has no node on a side") {
    Network network = threeAtAnEdge();
    const std::array corners{flow::OutlineCorner{{8, 0, 0}, 0.4}};
    flow::grade({network.nodes, network.triangles, network.patch_of}, corners);
    double area = 0, finest = kInfinity, coarsest = 0;
    std::map<std::pair<std::int32_t, std::int32_t>, int> sides;
    for (std::size_t t = 0; t < network.triangles.size(); ++t) {
        area += areaOf(network, t);
        const double side = longestSide(network, t);
        // At least half of 45 degrees, so the height is at least tan(22.5 deg) / 2 of the side.
        CHECK(2 * areaOf(network, t) >= 0.2 * side * side);
        finest = std::min(finest, side), coarsest = std::max(coarsest, side);
        for (std::size_t k = 0; k < 3; ++k)
            ++sides[std::minmax(network.triangles[t][k], network.triangles[t][(k + 1) % 3])];
    }
    CHECK(area == doctest::Approx(3 * 64).epsilon(1e-12));
    CHECK(finest <= 0.4 / 8);
    CHECK(coarsest > 4);
    for (const auto& [nodes, count] : sides) {
        const Vec3 &a = network.nodes[static_cast<std::size_t>(nodes.first)],
                   &b = network.nodes[static_cast<std::size_t>(nodes.second)];
        const Vec3 middle = 0.5 * (a + b);
        const bool on_rim =
            std::abs(middle.x()) == 8 || middle.y() == 0 || middle.y() == 8 || middle.z() == 8;
        const bool at_crossing = a.x() == 0 && b.x() == 0 && a.z() == 0 && b.z() == 0;
        const bool is_whole = count == (at_crossing ? 3 : on_rim ? 1 : 2);
        CHECK(is_whole);
    }
    CHECK(std::ranges::is_sorted(network.patch_of));
}

TEST_CASE("grading: without corners the mesh stays as it is") {
    Network network = threeAtAnEdge();
    flow::grade({network.nodes, network.triangles, network.patch_of}, {});
    CHECK(network.triangles == threeAtAnEdge().triangles);
}
