#include "flow/opening.h"

#include <doctest/doctest.h>

#include "build/build.h"
#include "flow/meshing.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;

namespace {

/// A box of 4 m x 1 m on the floor.
State boxOnFloor() {
    Model model = floorModel(30);
    addBox(model, "box", {0, 0, 0}, {4, 1, 1});
    return *buildState(std::move(model), false);
}

}  // namespace

TEST_CASE("opening: a lift opens the joint, a slide along it does not") {
    State state = boxOnFloor();
    const flow::Network network = flow::networkOf(state, 0);
    for (const double u : flow::openings(state, network)) CHECK(u == 0);
    state.blocks.position.set(1, state.blocks.position.get(1) + Vec3(0.3, -0.2, 1e-4));
    for (const double u : flow::openings(state, network)) CHECK(u == doctest::Approx(1e-4).epsilon(1e-9));
    state.blocks.position.set(1, state.blocks.position.get(1) - Vec3(0, 0, 3e-4));
    for (const double u : flow::openings(state, network)) CHECK(u == doctest::Approx(-2e-4).epsilon(1e-9));
}

TEST_CASE("opening: about an edge it grows with the distance from it") {
    State state = boxOnFloor();
    const flow::Network network = flow::networkOf(state, 1);
    constexpr double kAngle = 1e-5;
    const Eigen::Quaterniond turn = turnAbout(-Vec3::UnitY(), degrees(kAngle));  // lifts the end at +x
    const Vec3 centroid = state.blocks.position.get(1);
    const Eigen::Quaterniond before(state.blocks.orientation[1].w, state.blocks.orientation[1].x,
                                    state.blocks.orientation[1].y, state.blocks.orientation[1].z);
    const Eigen::Quaterniond after = turn * before;
    state.blocks.orientation[1] = {after.w(), after.x(), after.y(), after.z()};
    state.blocks.position.set(1, turn * centroid);  // about the edge at x = 0, z = 0
    const std::vector<double> opened = flow::openings(state, network);
    REQUIRE(opened.size() == flow::kPlaces * network.triangles.size());
    for (std::size_t t = 0; t < network.triangles.size(); ++t) {
        const double* u = &opened[flow::kPlaces * t];
        double mean = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double x = network.corner(t, k).x();
            CHECK(std::abs(u[1 + k] - kAngle * x) < 1e-4 * kAngle);
            mean += x / 3;
        }
        CHECK(u[0] == doctest::Approx(kAngle * mean).epsilon(1e-4));
    }
}

TEST_CASE("opening: bodies that move together open nothing") {
    Model model = stackModel(2, 2, 1, 30, {1, 1, 1});
    State state = *buildState(std::move(model), false);
    const flow::Network network = flow::networkOf(state, 0);
    const Vec3 by(0.1, 0.2, 0.3);
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        state.blocks.position.set(b, state.blocks.position.get(b) + by);
    for (const double u : flow::openings(state, network)) CHECK(std::abs(u) < 1e-14);
}
