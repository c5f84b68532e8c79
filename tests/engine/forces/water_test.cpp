#include "forces/water.h"

#include <doctest/doctest.h>

#include "build/build.h"
#include "model/over_time.h"
#include "step/motion.h"
#include "step/step.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kGammaWater = 1000 * 9.81;

/// Sum of water on a block; gravity off the scale by looking at the wet wrenches alone.
Wrench waterOnBlock(State& state, std::size_t b) {
    updateWater(state);
    Wrench sum;
    const Mat3 turn = state.blocks.orientation.matrix(b);
    for (std::size_t w = 0; w < state.wet.size(); ++w) {
        if (state.wet.block[w] != static_cast<std::int32_t>(b)) continue;
        sum.force += turn * state.wet.force.get(w);
        sum.torque += turn * state.wet.moment.get(w);
    }
    return sum;
}

/// Midpoint quadrature of the pressure p = rho g max(0, down . (x - table)) over a rectangle.
Wrench quadrature(const Vec3& corner, const Vec3& side_1, const Vec3& side_2, const Vec3& outward,
                  const Vec3& centroid, const Vec3& table, double tilt) {
    const Vec3 down(-std::sin(tilt), 0, -std::cos(tilt));
    const int n = 2000;
    Wrench sum;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Vec3 x = corner + (i + 0.5) / n * side_1 + (j + 0.5) / n * side_2;
            const double p = kGammaWater * std::max(0.0, down.dot(x - table));
            const Vec3 force = -p * side_1.cross(side_2).norm() / (n * n) * outward;
            sum.force += force;
            sum.torque += (x - centroid).cross(force);
        }
    return sum;
}

void checkClose(const Wrench& a, const Wrench& b, double relative) {
    CHECK((a.force - b.force).norm() < relative * b.force.norm());
    CHECK((a.torque - b.torque).norm() < relative * b.force.norm());
}

}  // namespace

TEST_SUITE("forces") {
    TEST_CASE("a wall across the slope: rho g cos(beta) H^2/2 per width, a third up (eq 16)") {
        for (const double tilt_deg : {0.0, 7.0, 25.0}) {
            Model model = floorModel(40);
            model.gravity.tilt = radians(tilt_deg);
            addBox(model, "box", {0, 0, 0}, {1, 2, 1.5});
            model.waters = {waterOn(model, 1, Vec3::UnitX(), 0.9)};
            State state = *buildState(model, false);
            const Wrench wrench = waterOnBlock(state, 1);
            const double thrust = kGammaWater * std::cos(radians(tilt_deg)) * 0.9 * 0.9 / 2 * 2;
            CHECK(wrench.force.x() == doctest::Approx(-thrust));
            CHECK(wrench.torque.y() == doctest::Approx(-thrust * (0.3 - 0.75)));
        }
    }

    TEST_CASE("a wall along the slope: the water line is inclined on it; against quadrature") {
        Model model = floorModel(40);
        const double tilt = radians(20);
        model.gravity.tilt = tilt;
        addBox(model, "box", {0.5, 0, 0}, {1, 0.6, 0.7});
        model.waters = {waterOn(model, 1, -Vec3::UnitY(), 0.4)};
        State state = *buildState(model, false);
        // The lowest point of the face is its corner at the toe; 0.4 m up the steepest line from there.
        const Vec3 up(std::sin(tilt), 0, std::cos(tilt));
        const Wrench exact = quadrature({0.5, 0, 0}, {1, 0, 0}, {0, 0, 0.7}, -Vec3::UnitY(), {1, 0.3, 0.35},
                                        Vec3(0.5, 0, 0) + 0.4 * up, tilt);
        checkClose(waterOnBlock(state, 1), exact, 1e-5);
    }

    TEST_CASE("elevation above the model's origin, on an inclined face of a wedge; against quadrature") {
        Model model;
        model.joints = {joint(30)};
        const double tilt = radians(12);
        model.gravity.tilt = tilt;
        Block wedge = box("wedge", {0, 0, 0}, {1, 1, 1});
        wedge.shape = *convexHull(
            {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}, {1, 0, 1}, {0, 0, 1}, {1, 1, 1}, {0, 1, 1}});
        model.blocks = {wedge};
        Water water = waterOn(model, 0, Vec3(1, 0, 1).normalized(), 0.0);
        water.kind = Water::Level::elevation;
        water.level = {{0.0, 0.55}};
        model.waters = {water};
        State state = *buildState(model, false);
        const Vec3 centroid = state.blocks.position.get(0);
        const Vec3 table = 0.55 * Vec3(std::sin(tilt), 0, std::cos(tilt));
        checkClose(
            waterOnBlock(state, 0),
            quadrature({2, 0, 0}, {-1, 0, 1}, {0, 1, 0}, Vec3(1, 0, 1).normalized(), centroid, table, tilt),
            1e-4);
    }

    TEST_CASE("perched water starts at its base and is measured from it") {
        Model model = floorModel(40);
        addBox(model, "box", {0, 0, 0}, {1, 1, 2});
        Water water = waterOn(model, 1, Vec3::UnitX(), 0.8);
        water.base = 0.5;
        model.waters = {water};
        State state = *buildState(model, false);
        const Wrench wrench = waterOnBlock(state, 1);
        const double thrust = kGammaWater * 0.8 * 0.8 / 2;
        CHECK(wrench.force.x() == doctest::Approx(-thrust));
        CHECK(wrench.torque.y() == doctest::Approx(-thrust * (0.5 + 0.8 / 3 - 1.0)));
    }

    TEST_CASE("water above the top presses on the whole face") {
        Model model = floorModel(40);
        addBox(model, "box", {0, 0, 0}, {1, 1, 0.5});
        model.waters = {waterOn(model, 1, Vec3::UnitX(), 2.0)};
        State state = *buildState(model, false);
        CHECK(waterOnBlock(state, 1).force.x() == doctest::Approx(-kGammaWater * (2.0 + 1.5) / 2 * 0.5));
    }

    TEST_CASE("a fissure pushes on both walls alike, block by block") {
        Model model = stackModel(2, 3, 1, 30);
        model.waters = {fissureAt(model, 0.2, 0.25)};
        State state = *buildState(model, false);
        CHECK(state.wet.size() == 6);
        for (std::size_t row = 0; row < 3; ++row) {
            const Vec3 front = waterOnBlock(state, 1 + row).force, back = waterOnBlock(state, 4 + row).force;
            CHECK((front + back).norm() < 1e-12);
            const double top = std::max(0.0, 0.25 - 0.1 * row), bottom = std::max(0.0, 0.15 - 0.1 * row);
            CHECK(front.x() == doctest::Approx(-kGammaWater * 0.1 * (top * top - bottom * bottom) / 2));
        }
    }

    TEST_CASE("uplift between two heads: rho g cos(beta) times the mean head, on both walls") {
        Model model = floorModel(40);
        model.gravity.tilt = radians(10);
        addBox(model, "key", {0.3, 0, 0}, {0.6, 0.5, 0.2});
        Water water;
        water.kind = Water::Level::head;
        water.head = {0.3, 0.1};
        water.pair = {{1, 0}};
        water.field = "water[0]";
        model.waters = {water};
        State state = *buildState(model, false);
        const Wrench key = waterOnBlock(state, 1);
        const double unit = kGammaWater * std::cos(radians(10));
        CHECK(key.force.z() == doctest::Approx(unit * 0.2 * 0.3));
        // integral of x p over the base about its middle: slope 0.2 m per 0.6 m times b^3/12 times the width
        CHECK(key.torque.y() == doctest::Approx(-unit * (0.2 / 0.6) * std::pow(0.6, 3) / 12 * 0.5));
        const Wrench floor = waterOnBlock(state, 0);
        CHECK((key.force + floor.force).norm() < 1e-9);
        const Vec3 moment = key.torque + floor.torque + state.blocks.position.get(1).cross(key.force) +
                            state.blocks.position.get(0).cross(floor.force);
        CHECK(moment.norm() < 1e-9);
    }

    TEST_CASE("levels over time are linear between their entries") {
        Water water;
        water.level = {{0, 0.1}, {2, 0.5}, {4, 0.3}};
        CHECK(levelAt(water, -1) == 0.1);
        CHECK(levelAt(water, 1) == doctest::Approx(0.3));
        CHECK(levelAt(water, 3) == doctest::Approx(0.4));
        CHECK(levelAt(water, 9) == 0.3);
    }

    TEST_CASE("a wall that has moved gets a new wrench, one that has not keeps it") {
        Model model = floorModel(40);
        addBox(model, "box", {0, 0, 0}, {1, 1, 1});
        model.waters = {waterOn(model, 1, Vec3::UnitX(), 0.5)};
        State state = *buildState(model, false);
        const double thrust = waterOnBlock(state, 1).force.x();
        state.blocks.position[1].z += 0.1;  // lifted out by 0.1 m: 0.4 m remain wet
        CHECK(waterOnBlock(state, 1).force.x() == doctest::Approx(thrust * 0.16 / 0.25));
    }

    TEST_CASE("a fissure that drains is empty for good once its joint opens too wide") {
        Model model = stackModel(2, 1, 1, 30);
        Water water = fissureAt(model, 0.2, 0.1);
        water.drains_at_aperture = 1e-3;
        model.waters = {water};
        State state = *buildState(model, false);
        state.blocks.position[1].x -= 0.5e-3;
        drainWater(state);
        CHECK(waterOnBlock(state, 1).force.x() < 0);
        state.blocks.position[1].x -= 1e-3;
        drainWater(state);
        CHECK(waterOnBlock(state, 1).force.x() == 0);
        state.blocks.position[1].x += 1.5e-3;
        drainWater(state);
        CHECK(waterOnBlock(state, 1).force.x() == 0);
    }

    TEST_CASE("bad water is an error with its field") {
        Model model = floorModel(40);
        addBox(model, "box", {0, 0, 0}, {1, 1, 1});
        model.waters = {waterOn(model, 1, Vec3::UnitX(), 0.5), waterOn(model, 1, Vec3::UnitX(), 0.2)};
        model.waters[1].field = "water[1]";
        const auto overlap = buildState(model, false);
        REQUIRE_FALSE(overlap.ok());
        CHECK(overlap.errors()[0].field == "water[1]");
        model.waters[1].base = 0.6;  // above the first one's table
        CHECK(buildState(model, false).ok());
        model.waters[1].base = 1.5;  // above the block
        CHECK_FALSE(buildState(model, false).ok());
    }
}
