#include "forces/loads.h"

#include <doctest/doctest.h>

#include "build/build.h"
#include "forces/sum.h"
#include "measure/measure.h"
#include "step/step.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;

namespace {

AppliedLoad forceAt(std::int32_t block, const Vec3& force, std::optional<Vec3> point = std::nullopt) {
    return {
        .kind = AppliedLoad::Kind::force, .block = block, .force = force, .point = point, .field = "load[0]"};
}

AppliedLoad onFace(std::int32_t block, const Vec3& direction, double pressure) {
    return {.kind = AppliedLoad::Kind::face,
            .block = block,
            .direction = direction,
            .pressure = pressure,
            .field = "load[0]"};
}

AppliedLoad inBox(const Vec3& min, const Vec3& max, const Vec3& direction, double pressure) {
    return {.kind = AppliedLoad::Kind::box,
            .direction = direction,
            .pressure = pressure,
            .box_min = min,
            .box_max = max,
            .field = "load[0]"};
}

/// A box 1 x 2 x 1.5 m on the floor, its lower corner at the origin, and a load.
Model loaded(AppliedLoad load) {
    Model model = floorModel(30);
    addBox(model, "box", {0, 0, 0}, {1, 2, 1.5});
    model.loads = {std::move(load)};
    return model;
}

const Vec3 kCentroid(0.5, 1, 0.75);

void checkWrench(const Wrench& found, const Vec3& force, const Vec3& torque) {
    CHECK((found.force - force).norm() <= 1e-12 * (1 + force.norm()));
    CHECK((found.torque - torque).norm() <= 1e-12 * (1 + torque.norm()));
}

/// Turns a block where it is.
void turn(State& state, std::size_t block, const Eigen::Quaterniond& by) {
    const Quaternion& q = state.blocks.orientation[block];
    const Eigen::Quaterniond turned = by * Eigen::Quaterniond(q.w, q.x, q.y, q.z);
    state.blocks.orientation[block] = {turned.w(), turned.x(), turned.y(), turned.z()};
}

}  // namespace

TEST_SUITE("forces") {
    TEST_CASE("a force acts at its point, which turns with the block, and keeps its direction") {
        const Vec3 force(3e3, -2e3, -5e4), point(1, 0.5, 1.5), arm = point - kCentroid;
        State state = *buildState(loaded(forceAt(1, force, point)), false);
        checkWrench(blockForcesOn(state, 1), force, arm.cross(force));
        checkWrench(blockForcesOn(state, 0), Vec3::Zero(), Vec3::Zero());
        const Eigen::Quaterniond by = turnAbout({1, 2, 3}, 50);
        turn(state, 1, by);
        checkWrench(blockForcesOn(state, 1), force, (by * arm).cross(force));
    }

    TEST_CASE("a force without a point acts at the centroid") {
        const State state = *buildState(loaded(forceAt(1, {1e3, 0, 0})), false);
        checkWrench(blockForcesOn(state, 1), {1e3, 0, 0}, Vec3::Zero());
    }

    TEST_CASE("far from the model's origin the point is still that of the model") {
        Model model = loaded(forceAt(1, {0, 0, -1e3}, Vec3(1, 2, 1.5)));
        const Vec3 far(1e6, -2e6, 0);
        for (Block& block : model.blocks)
            for (Vec3& v : block.shape.vertices) v += far;
        *model.loads[0].point += far;
        const Wrench found = blockForcesOn(*buildState(model, false), 1);
        CHECK((found.torque - Vec3(0.5, 1, 0.75).cross(Vec3(0, 0, -1e3))).norm() < 1e-6);
    }

    TEST_CASE("a pressure pushes on the whole face that is nearest to its direction") {
        const Wrench top = blockForcesOn(*buildState(loaded(onFace(1, Vec3::UnitZ(), 2e4)), false), 1);
        checkWrench(top, {0, 0, -2e4 * 2}, Vec3::Zero());
        const Wrench side = blockForcesOn(*buildState(loaded(onFace(1, -Vec3::UnitX(), 1e4)), false), 1);
        checkWrench(side, {1e4 * 3, 0, 0}, Vec3::Zero());
    }

    TEST_CASE("a pressure in a box pushes on the part of faces that is inside and free") {
        // Half of the top lies in the box, and of that a block of 0.25 x 1 m covers a part.
        Model model = loaded(inBox({-1, -1, 1.4}, {0.5, 3, 1.6}, Vec3::UnitZ(), 1e4));
        const Wrench half = blockForcesOn(*buildState(model, false), 1);
        const Vec3 middle = Vec3(0.25, 1, 1.5) - kCentroid;
        checkWrench(half, {0, 0, -1e4}, middle.cross(Vec3(0, 0, -1e4)));
        addBox(model, "on top", {0.25, 0, 1.5}, {0.5, 1, 0.5});  // reaches out of the box
        const State covered = *buildState(model, false);
        const Vec3 taken = Vec3(0.375, 0.5, 1.5) - kCentroid;
        checkWrench(blockForcesOn(covered, 1), {0, 0, -1e4 * 0.75},
                    middle.cross(Vec3(0, 0, -1e4)) - taken.cross(Vec3(0, 0, -2.5e3)));
        checkWrench(blockForcesOn(covered, 2), Vec3::Zero(), Vec3::Zero());  // its top is above the box
    }

    TEST_CASE("a wall of blocks under one pressure feels the wrench of the whole") {
        Model model = stackModel(3, 2, 2, 30, {0.2, 0.1, 0.1}, 1e10);
        model.loads = {inBox({-0.1, 0, 0.05}, {1, 0.15, 0.4}, -Vec3::UnitX(), 7e3)};
        const State state = *buildState(model, false);
        Wrench sum;
        for (std::size_t b = 1; b < state.blocks.size(); ++b) {
            const Wrench on = blockForcesOn(state, b);
            sum.force += on.force;
            sum.torque += on.torque + state.blocks.position.get(b).cross(on.force);
        }
        const Vec3 force(7e3 * 0.15 * 0.15, 0, 0);  // of the toe's face, y to 0.15, z from 0.05 to 0.2
        checkWrench(sum, force, Vec3(0, 0.075, 0.125).cross(force));
    }

    TEST_CASE("faces count within 60 degrees of a direction; only those of free blocks") {
        for (const auto& [dip, found] : {std::pair{59.9, true}, {60.1, false}}) {
            Model model = floorModel(30);
            addTurnedCube(model, "cube", turnAbout(Vec3::UnitY(), dip), 0, 0, 0.0, 1.0);
            model.loads = {inBox({-3, -3, -3}, {3, 3, 3}, Vec3::UnitZ(), 1e4)};
            const Wrench on = blockForcesOn(*buildState(model, false), 1);
            // The other face that looks up is turned by 90 degrees less.
            const double angle = radians(dip), other = radians(90) - angle;
            Vec3 force = -1e4 * Vec3(-std::sin(other), 0, std::cos(other));
            if (found) force += -1e4 * Vec3(std::sin(angle), 0, std::cos(angle));
            CHECK((on.force - force).norm() < 1e-6);
        }
    }

    TEST_CASE("errors: a block that no force moves, a box without a face") {
        const auto errorOf = [](AppliedLoad load) {
            const auto errors = buildState(loaded(std::move(load)), false).errors();
            REQUIRE(errors.size() == 1);
            return errors[0].field;
        };
        CHECK(errorOf(forceAt(0, {1, 0, 0})) == "load[0].block");
        CHECK(errorOf(onFace(0, Vec3::UnitZ(), 1)) == "load[0].block");
        CHECK(errorOf(inBox({5, 5, 5}, {6, 6, 6}, Vec3::UnitZ(), 1)) == "load[0].box");
        CHECK(errorOf(inBox({-9, -9, -9}, {9, 9, 9}, -Vec3::UnitZ(), 1)) ==
              "load[0].box");  // it is on the floor
    }

    TEST_CASE("a load follows its table over time, and comes with the weight") {
        AppliedLoad load = forceAt(1, {0, 0, -1e3});
        load.factor = {{0, 0.5}, {2, 1.5}};
        State state = *buildState(loaded(load), false);
        for (const auto& [time, factor] : {std::pair{0.0, 0.5}, {1.0, 1.0}, {5.0, 1.5}}) {
            state.load.time = time;
            CHECK(blockForcesOn(state, 1).force.z() == doctest::Approx(-1e3 * factor).epsilon(1e-15));
        }
        state.load.gravity_share = 0.25;
        CHECK(blockForcesOn(state, 1).force.z() == doctest::Approx(-375).epsilon(1e-15));
    }

    TEST_CASE("dead forces: moment by a small turn, and work, are those of their points") {
        Model model = loaded(forceAt(1, {3e3, -2e3, -5e4}, Vec3(1, 0.5, 1.5)));
        model.gravity.magnitude = 0;
        model.loads.push_back(onFace(1, Vec3::UnitY(), 5e3));
        State state = *buildState(model, false);
        const DeadForce dead = deadForcesOn(state, 1);
        const Mat3 at = turnAbout({3, 1, 2}, 40).toRotationMatrix();
        for (int axis = 0; axis < 3; ++axis) {
            const double small = 1e-6;
            const auto turned = [&](double by) {
                return dead.at(Eigen::AngleAxisd(by, Vec3::Unit(axis)).toRotationMatrix() * at).torque;
            };
            const Vec3 slope = (turned(small) - turned(-small)) / (2 * small);
            CHECK((slope - dead.torqueByTurn(at).col(axis)).norm() < 1e-8 * dead.arms.norm());
        }
        CHECK(gravityEnergy(state) == 0);
        const Eigen::Quaterniond by = turnAbout({1, -2, 1}, 70);
        turn(state, 1, by);
        const Vec3 shift(0.1, 0.2, -0.3);
        state.blocks.position.set(1, state.blocks.position.get(1) + shift);
        double work = 0;
        for (const auto& [point, force] : {std::pair<Vec3, Vec3>{{1, 0.5, 1.5}, {3e3, -2e3, -5e4}},
                                           {{0.5, 2, 0.75}, {0, -5e3 * 1.5, 0}}}) {
            const Vec3 arm = point - kCentroid;
            work += force.dot(shift + by * arm - arm);
        }
        CHECK(gravityEnergy(state) == doctest::Approx(-work).epsilon(1e-12));
    }
}
