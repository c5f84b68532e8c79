#include "flow/footprints.h"

#include <doctest/doctest.h>

#include "build/build.h"
#include "flow/meshing.h"
#include "support/flows.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;
using talus::flow::Footprint;

namespace {

/// Of a boundary in a box of a joint of 8 m by 4 m on the floor.
std::vector<Footprint> footprints(const Vec3& low, const Vec3& high, const std::optional<Vec3>& face = {}) {
    Model model = floorModel(30);
    addBox(model, "box", {0, 0, 0}, {8, 4, 1});
    FlowBoundary boundary;
    boundary.box_min = low;
    boundary.box_max = high;
    boundary.face = face;
    const State state = *buildState(std::move(model), false);
    const flow::Network network = flow::networkOf(state, 0);
    return flow::footprintsOf(network, std::array{boundary}, state.geometry->origin);
}

}  // namespace

TEST_CASE("footprints: a drain inside a polygon has an outline as fine as its width") {
    const auto found = footprints({3, 1, -1}, {3.8, 1.4, 1});
    REQUIRE(found.size() == 1);
    CHECK(found[0].corners.size() == 4);
    CHECK(found[0].size == doctest::Approx(0.4 / 8));
}

TEST_CASE("footprints: a thin drain is as fine as a share of its length") {
    const auto found = footprints({1, 1, -1}, {7.4, 1.001, 1});
    REQUIRE(found.size() == 1);
    CHECK(found[0].size == doctest::Approx(6.4 / 64));
}

TEST_CASE("footprints: a box from edge to edge ends at lines, with sides of any length") {
    const auto found = footprints({3, -1, -1}, {3.8, 5, 1});
    REQUIRE(found.size() == 1);
    CHECK(found[0].size == kInfinity);
}

TEST_CASE("footprints: a corner of a box on an edge of the polygon is none inside it") {
    for (const double end : {4.0, 4 + 1e-7, 4 - 1e-7}) {
        const auto found = footprints({3, 0, -1}, {3.8, end, 1});
        REQUIRE(found.size() == 1);
        CHECK(found[0].size == kInfinity);
    }
}

TEST_CASE("footprints: none of a box that holds the whole polygon, nor of one beside it or above it") {
    CHECK(footprints({-1, -1, -1}, {9, 5, 1}).empty());
    CHECK(footprints({0, 0, 0}, {8, 4, 1}).empty());
    CHECK(footprints({9, 0, -1}, {10, 4, 1}).empty());
    CHECK(footprints({3, 1, 0.5}, {4, 2, 1}).empty());
}

TEST_CASE("footprints: a box that touches an edge, and a part of an open end, end inside that edge") {
    const auto touching = footprints({8, 1, -0.2}, {8.4, 1.4, 0.2});
    REQUIRE(touching.size() == 1);
    CHECK(touching[0].size == doctest::Approx(0.4 / 8));
    const auto end = footprints({-1, 1, -1}, {9, 1.4, 1}, Vec3::UnitX());
    REQUIRE(end.size() == 1);
    CHECK(end[0].corners.size() == 2);
    CHECK(end[0].size == doctest::Approx(0.4 / 8));
    CHECK(footprints({-1, -1, -1}, {9, 5, 1}, Vec3::UnitX()).empty());
}

TEST_CASE("footprints: what a box reaches outside a polygon does not count") {
    for (const double far : {8.1, 9.0, 1e3, kInfinity}) {
        const auto found = footprints({7.6, 1, -1}, {far, 1.8, 1});
        REQUIRE(found.size() == 1);
        CHECK(found[0].size == doctest::Approx(0.4 / 8));
    }
}

TEST_CASE("footprints: sides may be longer with the distance from the outline, and within it") {
    const Footprint drain = footprints({3, 1, -1}, {3.8, 1.4, 1}).at(0);
    const auto isTooLarge = [&](double x, double y, double side) {
        return flow::isTooLarge(drain, {Vec3(x, y, 0), Vec3(x + side, y, 0), Vec3(x, y + side, 0)});
    };
    CHECK(isTooLarge(2.98, 1.1, 0.04));  // the longest side is sqrt(2) of that
    CHECK_FALSE(isTooLarge(2.98, 1.1, 0.03));
    CHECK_FALSE(isTooLarge(3.1, 1.1, 0.1));  // inside
    CHECK(isTooLarge(2.5, 0.5, 6));          // holds the drain
    CHECK_FALSE(isTooLarge(5.8, 1.1, 0.7));  // 2 m beside
    CHECK(isTooLarge(5.8, 1.1, 0.72));
}

TEST_CASE("footprints: a side crosses the outline, or lies on it") {
    const Footprint drain = footprints({3, 1, -1}, {3.8, 1.4, 1}).at(0);
    const auto met = flow::crossing(drain, {2, 1.2, 0}, {3.2, 1.2, 0});
    REQUIRE(met);
    CHECK((*met - Vec3(3, 1.2, 0)).norm() < 1e-9);
    CHECK_FALSE(flow::crossing(drain, {2, 1.2, 0}, {3, 1.2, 0}));      // ends on it
    CHECK_FALSE(flow::crossing(drain, {2, 2, 0}, {4, 2, 0}));          // passes beside
    CHECK_FALSE(flow::crossing(drain, {3.1, 1.1, 0}, {3.5, 1.3, 0}));  // inside
    CHECK(flow::crossing(drain, {2, 1, 0}, {3.5, 1, 0}));              // along it, at a corner
    CHECK(flow::isOnOutline(drain, {3, 1.1, 0}, {3, 1.3, 0}));
    CHECK_FALSE(flow::isOnOutline(drain, {3, 1.1, 0}, {3.1, 1.3, 0}));
    const Footprint end = footprints({-1, 1, -1}, {9, 1.4, 1}, Vec3::UnitX()).at(0);
    const auto corner = flow::crossing(end, {8, 0, 0}, {8, 1.2, 0});
    REQUIRE(corner);
    CHECK((*corner - Vec3(8, 1, 0)).norm() < 1e-5);
    CHECK_FALSE(flow::crossing(end, {7, 0, 0}, {7, 1.2, 0}));
}
