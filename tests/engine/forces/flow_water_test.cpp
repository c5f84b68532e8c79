#include "forces/flow_water.h"

#include <doctest/doctest.h>

#include <random>

#include "build/build.h"
#include "forces/sum.h"
#include "support/flows.h"

using namespace talus;
using namespace talus::test;

namespace {

Wrench waterOnBlock(const State& state, std::size_t block) {
    Wrench sum;
    eachBlockForce(state, [&](const BlockForce& force, const ForceParts& parts) {
        if (std::string(force.name) == "flow") sum += force.on(state, parts, block);
    });
    return sum;
}

/// A box on the floor under a head that falls from 5 m at x = 0 to 1 m at x = 4.
Model underHead() {
    Model model = floorModel(30);
    addBox(model, "box", {0, 0, 0}, {4, 1, 1});
    model.flow = flowAlongX(1e-4, 5, 1);
    return model;
}

}  // namespace

TEST_CASE("flow water: a linear pressure on a triangle, against sums over a fine grid") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> between(-1, 1);
    const auto point = [&] { return Vec3(between(random), between(random), between(random)); };
    for (int trial = 0; trial < 20; ++trial) {
        const std::array<Vec3, 3> x{point(), point(), point()};
        const std::array<double, 3> p{between(random), between(random), between(random)};
        const double area = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm();
        constexpr int kParts = 300;
        double force = 0;
        Vec3 moment = Vec3::Zero();
        for (int i = 0; i < kParts; ++i)
            for (int j = 0; i + j < kParts; ++j)
                for (const double third : {1.0 / 3, 2.0 / 3}) {
                    if (third > 0.5 && i + j + 1 >= kParts) continue;
                    const double a = (i + third) / kParts, b = (j + third) / kParts, c = 1 - a - b;
                    const double push =
                        std::max(0.0, c * p[0] + a * p[1] + b * p[2]) * area / (kParts * kParts);
                    force += push;
                    moment += push * (a * (x[1] - x[0]) + b * (x[2] - x[0]));
                }
        const auto found = flow_water::pushOn(x, p);
        CHECK(std::abs(found.force - force) < 1e-4 * area);
        CHECK((found.moment - moment).norm() < 1e-4 * area);
    }
}

TEST_CASE("flow water: uplift of a linear head, and its moment about the centroid") {
    const State state = *buildState(underHead(), false);
    const Wrench found = waterOnBlock(state, 1);
    // p = 9810 (5 - x): force 9810 * 3 * 4, centre at x = (5 * 8 - 64 / 3) / 12.
    const double force = 9810 * 12, arm = (5 * 8 - 64.0 / 3) / 12 - 2;
    CHECK((found.force - Vec3(0, 0, force)).norm() < 1e-9 * force);
    CHECK((found.torque - Vec3(0, -arm * force, 0)).norm() < 1e-9 * force);
    CHECK((waterOnBlock(state, 0).force + found.force).norm() < 1e-9 * force);
}

TEST_CASE("flow water: turns with its block, follows its share, and is found only once") {
    State state = *buildState(underHead(), false);
    const Wrench before = waterOnBlock(state, 1);
    state.load.water_share = 0.25;
    CHECK((waterOnBlock(state, 1).force - 0.25 * before.force).norm() < 1e-9 * before.force.norm());
    state.load.water_share = 1;
    const Eigen::Quaterniond by = turnAbout({1, 2, 3}, 40);
    state.blocks.orientation[1] = {by.w(), by.x(), by.y(), by.z()};
    state.blocks.position.set(1, Vec3(9, 9, 9));
    updateBlockForces(state);
    const Mat3 turn = by.toRotationMatrix();
    CHECK((waterOnBlock(state, 1).force - turn * before.force).norm() < 1e-9 * before.force.norm());
    CHECK((waterOnBlock(state, 1).torque - turn * before.torque).norm() < 1e-9 * before.force.norm());
}

TEST_CASE("flow water: a full network under one level of water has the buoyancy of its free blocks' joints") {
    // No flow: heads are equal, and pressure is hydrostatic. The middle block is under water on all sides.
    Model model = stackModel(3, 3, 3, 30, {1, 1, 1});
    model.flow = flowAlongX(1e-4, 10, 10);
    const State state = *buildState(std::move(model), false);
    const std::size_t middle = 1 + 13;
    REQUIRE(state.geometry->model.blocks[middle].name == "c2r2s2");
    const Wrench found = waterOnBlock(state, middle);
    CHECK((found.force - Vec3(0, 0, 9810)).norm() < 1e-6 * 9810);
    CHECK(found.torque.norm() < 1e-6 * 9810);
}

TEST_CASE("flow water: a free surface inside a polygon has the hydrostatic thrust, rho g d^2 / 2") {
    // A crack between a block and a fixed wall, ten metres high above a step, filled to this depth.
    for (const double depth : {0.5, 2.0, 5.0, 9.5}) {
        CAPTURE(depth);
        Model model = floorModel(30);
        addBox(model, "body", {0, 0, 0}, {4, 1, 11});
        model.blocks.push_back(box("wall", {4, 0, 1}, {6, 1, 11}, 2700, Motion::fixed));
        FlowBoundary crack = headAt(Vec3::UnitZ(), 1 + depth);
        crack.face.reset();
        crack.box_min = Vec3(3.9, 0, 0.9);
        crack.box_max = Vec3(4.1, 1, 11);
        model.flow = Flow{.aperture = 1e-4, .boundaries = {crack}, .field = "flow"};
        const State state = *buildState(std::move(model), false);
        const double thrust = 9810 * depth * depth / 2, arm = 1 + depth / 3 - 5.5;
        const Wrench found = waterOnBlock(state, 1);
        CHECK((found.force - Vec3(-thrust, 0, 0)).norm() < 1e-9 * thrust);
        CHECK((found.torque - Vec3(0, -arm * thrust, 0)).norm() < 1e-8 * thrust);
    }
}

TEST_CASE("flow water: far from the origin it is the same") {
    Model far = underHead();
    const Vec3 shift(4e5, 5e6, 0);
    for (Block& block : far.blocks)
        for (Vec3& v : block.shape.vertices) v += shift;
    const State near_state = *buildState(underHead(), false), far_state = *buildState(std::move(far), false);
    const Wrench a = waterOnBlock(near_state, 1), b = waterOnBlock(far_state, 1);
    CHECK((a.force - b.force).norm() < 1e-7 * a.force.norm());
    CHECK((a.torque - b.torque).norm() < 1e-7 * a.force.norm());
}

TEST_CASE("flow water: beside other water of a joint it is refused, beside water on a free face it is not") {
    Model model = underHead();
    model.phreatic = PhreaticSurface{.line = {{0, 1}, {9, 1}}, .field = "water[0]"};
    CHECK_FALSE(buildState(model, false).ok());
    model.phreatic.reset();
    Water water;
    water.field = "water[0]";
    water.level = {{0, 0.5}};
    water.walls = {{1, faceTowards(model, 1, -Vec3::UnitZ())}};
    model.waters = {water};
    const auto refused = buildState(model, false);
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.errors().front().field == "water[0]");
    model.waters[0].walls = {{1, faceTowards(model, 1, -Vec3::UnitX())}};
    CHECK(buildState(model, false).ok());
}
