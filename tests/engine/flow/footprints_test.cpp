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

TEST_CASE("footprints: a box from edge to edge ends at lines, half as fine as it is wide") {
    const auto found = footprints({3, -1, -1}, {3.8, 5, 1});
    REQUIRE(found.size() == 1);
    CHECK(found[0].size == doctest::Approx(0.8 / 2));
}

TEST_CASE("footprints: a corner of a box on an edge of the polygon is none inside it") {
    for (const double end : {4.0, 4 + 1e-7, 4 - 1e-7}) {
        const auto found = footprints({3, 0, -1}, {3.8, end, 1});
        REQUIRE(found.size() == 1);
        CHECK(found[0].size == doctest::Approx(0.8 / 2));
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

TEST_CASE("footprints: sides may be longer with the distance from the outline, and within it") {
    const Footprint drain = footprints({3, 1, -1}, {3.8, 1.4, 1}).at(0);
    const auto most = [&](double x, double y, double side) {
        return flow::mostSide(drain, {Vec3(x, y, 0), Vec3(x + side, y, 0), Vec3(x, y + side, 0)});
    };
    CHECK(most(2.9, 1.1, 0.2) == drain.size);
    CHECK(most(3.1, 1.1, 0.1) == kInfinity);
    CHECK(most(2.5, 0.5, 6) == drain.size);  // holds the drain
    CHECK(most(5.8, 1.1, 0.1) == doctest::Approx(0.5 * 2));
}
