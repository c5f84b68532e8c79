#include "flow/network.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "build/build.h"
#include "flow/meshing.h"
#include "state/closed_gap.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;
using talus::flow::Network;

namespace {

double areaOf(const Network& network) {
    double area = 0;
    for (std::size_t t = 0; t < network.triangles.size(); ++t) {
        const Vec3 across =
            (network.corner(t, 1) - network.corner(t, 0)).cross(network.corner(t, 2) - network.corner(t, 0));
        CHECK(across.dot(network.patch(t).normal) > 0);
        area += 0.5 * across.norm();
    }
    return area;
}

/// Slices of one column that the ones of its neighbour do not continue: nodes hang on edges.
Model shiftedSlices() {
    Model model = floorModel(30);
    addBox(model, "left", {0, 0, 0}, {1, 2, 1});
    addBox(model, "left2", {0, 0, 1}, {1, 2, 1});
    addBox(model, "near", {1, 0, 0}, {1, 0.7, 2});
    addBox(model, "far", {1, 0.7, 0}, {1, 1.3, 2});
    return model;
}

}  // namespace

TEST_CASE("network: patches of a stack share the nodes where they meet") {
    const State state = *buildState(stackModel(2, 2, 1, 30, {1, 1, 1}), false);
    const Network network = flow::networkOf(state, 0);
    // Two beds on the floor, two between the rows, two patches between the columns.
    CHECK(network.patches.size() == 6);
    CHECK(network.nodes.size() == 2 * 7 + 6);  // seven ends and crossings, twice, and the centres
    CHECK(network.triangles.size() == 24);
    CHECK(areaOf(network) == doctest::Approx(6));
    const auto parts = flow::connectedParts(network);
    CHECK(*std::max_element(parts.begin(), parts.end()) == 0);
    for (const Vec3& x : network.nodes) CHECK(std::abs(x.y() - 0.5) <= 0.5 + 1e-12);
}

TEST_CASE("network: corners on an edge of another patch are nodes of it, so nothing is open inside") {
    const State state = *buildState(shiftedSlices(), false);
    for (const int refinements : {0, 1, 2}) {
        CAPTURE(refinements);
        const Network network = flow::networkOf(state, refinements);
        CHECK(areaOf(network) == doctest::Approx(2 * 2 + 2 + 2 * 2 + 2));
        std::set<int> sides;
        for (const auto& edge : flow::openEdges(network)) {
            const Vec3 middle = 0.5 * (network.nodes[static_cast<std::size_t>(edge.nodes[0])] +
                                       network.nodes[static_cast<std::size_t>(edge.nodes[1])]);
            const bool outside = middle.x() < 1e-9 || middle.x() > 2 - 1e-9 || middle.y() < 1e-9 ||
                                 middle.y() > 2 - 1e-9 || middle.z() > 2 - 1e-9;
            CHECK(outside);
            // Outward.
            CHECK(edge.outward.dot(middle - Vec3(1, 1, 1)) > 0);
        }
    }
}

TEST_CASE("network: blocks whose coordinates are rounded share their nodes as exact ones do") {
    // Faces touch across gaps below kClosedGap. Four cubes around a crossing, moved apart by shares of it.
    for (const double gap : {0.0, 2e-5, 0.9e-4}) {
        CAPTURE(gap);
        Model model;
        model.joints = {joint(30)};
        for (const int column : {0, 1})
            for (const int row : {0, 1})
                addBox(model, std::to_string(2 * column + row), {column * (1 + gap), 0, row * (1 + gap)},
                       {1, 1, 1});
        const State state = *buildState(std::move(model), false);
        const Network network = flow::networkOf(state, 0);
        CHECK(network.patches.size() == 4);
        CHECK(network.nodes.size() == 2 * 5 + 4);  // four ends and a crossing, twice, and the centres
        for (const auto& edge : flow::openEdges(network)) {
            const Vec3 middle = 0.5 * (network.nodes[static_cast<std::size_t>(edge.nodes[0])] +
                                       network.nodes[static_cast<std::size_t>(edge.nodes[1])]);
            CHECK((middle - Vec3(1, 0.5, 1)).norm() > 0.4);  // not at the crossing
        }
    }
}

TEST_CASE("network: an open end looks the way of the rock face it lies on, not along its joint") {
    // A slab of two prisms, whose joint crosses it at 45 degrees.
    const auto prism = [](std::vector<Vec3> base) {
        for (std::size_t k = 0; k < 4; ++k) base.push_back(base[k] + Vec3::UnitZ());
        return *convexHull(base);
    };
    Model model = floorModel(30);
    addBox(model, "west", {0, 0, 0}, {1, 1, 1});
    addBox(model, "east", {0, 0, 0}, {1, 1, 1});
    model.blocks[1].shape = prism({{0, 0, 0}, {0.5, 0, 0}, {1.5, 1, 0}, {0, 1, 0}});
    model.blocks[2].shape = prism({{0.5, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1.5, 1, 0}});
    const State state = *buildState(std::move(model), false);
    const Network network = flow::networkOf(state, 1);
    std::size_t across = 0;
    for (const auto& edge : flow::openEdges(network)) {
        if (std::abs(network.patch(edge.triangle).normal.z()) > 0.5) continue;
        const double y = network.nodes[static_cast<std::size_t>(edge.nodes[0])].y();
        const bool on_top = edge.outward.z() > 0.5;
        if (on_top) continue;
        CHECK((edge.outward - Vec3(0, y < 0.5 ? -1 : 1, 0)).norm() < 1e-9);
        ++across;
    }
    CHECK(across == 4);
}

TEST_CASE("network: faces that lie near each other without touching are no joint") {
    // The contact search makes an interface of faces 30 mm apart; both blocks stand on the floor.
    for (const double gap : {0.0, 0.9e-4, 3e-4, 0.03}) {
        CAPTURE(gap);
        Model model = floorModel(30);
        addBox(model, "one", {0, 0, 0}, {1, 1, 1});
        addBox(model, "other", {1 + gap, 0, 0}, {1, 1, 1});
        const State state = *buildState(std::move(model), false);
        const bool touches = gap <= kClosedGap * state.geometry->size[1];
        CHECK(flow::networkOf(state, 0).patches.size() == (touches ? 3 : 2));
    }
}

TEST_CASE("network: blocks that do not touch are parts of their own") {
    Model model = floorModel(30);
    addBox(model, "one", {0, 0, 0}, {1, 1, 1});
    addBox(model, "other", {3, 0, 0}, {1, 1, 1});
    const State state = *buildState(std::move(model), false);
    const Network network = flow::networkOf(state, 0);
    const auto parts = flow::connectedParts(network);
    CHECK(std::set<std::int32_t>(parts.begin(), parts.end()) == std::set<std::int32_t>{0, 1});
}
