#include "equilibrium/first_order_gaps.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "build/build.h"
#include "forces/contact_forces.h"
#include "measure/measure.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;
using equilibrium::FirstOrderGaps;

namespace {

constexpr double kWidth = 0.3, kHeight = 0.8;

State twoColumns() { return *buildState(stackModel(2, 1, 1, 30, {kWidth, 0.1, kHeight}), false); }

/// The joint between the two columns: their blocks are 1 and 2.
std::size_t jointBetween(const State& state) {
    for (std::size_t i = 0; i < state.interfaces.size(); ++i)
        if (std::min(state.interfaces.block_a[i], state.interfaces.block_b[i]) == 1) return i;
    FAIL("no joint between the columns");
    return 0;
}

/// Turns a block about its lower edge on the downhill side.
void overturn(State& state, std::size_t block, double angle) {
    const Vec3 arm(-0.5 * kWidth, 0, -0.5 * kHeight);
    const Eigen::AngleAxisd turn(-angle, Vec3::UnitY());
    state.blocks.position.set(block, state.blocks.position.get(block) + arm - turn * arm);
    const Eigen::Quaterniond q(turn);
    state.blocks.orientation[block] = {q.w(), q.x(), q.y(), q.z()};
}

/// Of a joint at its upper and lower edge [m]: signs and order are those of the interface.
Vec2 gapsAt(const State& state, std::size_t i, double height) {
    const RelativePose pose = relativePose(state, i);
    Vec2 gaps = Vec2::Zero();
    for (std::size_t k = 0; k < state.interfaces.cornerCount(i); ++k) {
        const std::size_t slot = state.interfaces.cornerSlot(i, k);
        const double xi = state.interfaces.corners.get(slot, 0), eta = state.interfaces.corners.get(slot, 1);
        const double z = (pose.origin + xi * pose.e1 + eta * pose.e2).z();
        gaps[z > 0.5 * height ? 1 : 0] = pose.gap.dot(Vec3(1.0, xi, eta));
    }
    return gaps;
}

/// Of what was there when the state was `made`.
FirstOrderGaps setIn(State& state, const State& made) {
    FirstOrderGaps gaps(made);
    gaps.set(state, state.blocks.position, state.blocks.orientation);
    return gaps;
}

}  // namespace

TEST_SUITE("equilibrium") {
    TEST_CASE("columns that turn together press their joint by w (1 - cos t), but not to first order") {
        for (const double angle : {1e-5, 1e-4, 1e-3}) {
            CAPTURE(angle);
            const State stood = twoColumns();
            const std::size_t i = jointBetween(stood);
            State state = stood;
            overturn(state, 1, angle);
            overturn(state, 2, angle);
            const double pressed = kWidth * (1.0 - std::cos(angle));
            CHECK(gapsAt(state, i, kHeight).x() == doctest::Approx(-pressed).epsilon(1e-3));
            CHECK(gapsAt(state, i, kHeight).y() == doctest::Approx(-pressed).epsilon(1e-3));
            setIn(state, stood);
            CHECK(gapsAt(state, i, kHeight).cwiseAbs().maxCoeff() < 1e-3 * pressed + 1e-15);
        }
    }

    TEST_CASE("one column that overturns opens the joint behind it by its height times the angle") {
        const double angle = 1e-3;
        const State stood = twoColumns();
        const std::size_t i = jointBetween(stood);
        State state = stood;
        overturn(state, 1, angle);
        setIn(state, stood);
        const Vec2 gaps = gapsAt(state, i, kHeight);
        CHECK(std::abs(gaps.x()) < kWidth * angle * angle);
        CHECK(gaps.y() == doctest::Approx(kHeight * angle).epsilon(1e-6));
    }

    TEST_CASE("blocks that only shift have exact gaps") {
        const State stood = twoColumns();
        State state = stood;
        state.blocks.position.set(2, state.blocks.position.get(2) + Vec3(1e-3, 2e-3, 3e-3));
        const Vec2 before = gapsAt(state, jointBetween(state), kHeight);
        setIn(state, stood);
        CHECK((gapsAt(state, jointBetween(state), kHeight) - before).norm() < 1e-15);
    }

    TEST_CASE("gaps that were set and removed are exact again, to the bit") {
        const State stood = twoColumns();
        State state = stood;
        overturn(state, 1, 1e-3);
        overturn(state, 2, 2e-3);
        const State exact = state;
        const FirstOrderGaps gaps = setIn(state, stood);
        CHECK(stateHash(state) != stateHash(exact));
        gaps.remove(state);
        CHECK(stateHash(state) == stateHash(exact));
    }

    TEST_CASE("gaps of first order count from the model as built, whenever they are made") {
        const State stood = twoColumns();
        const std::size_t i = jointBetween(stood);
        State state = stood;
        overturn(state, 1, 1e-3);
        overturn(state, 2, 1e-3);
        setIn(state, State(state));
        CHECK(gapsAt(state, i, kHeight).cwiseAbs().maxCoeff() < 1e-3 * kWidth * (1.0 - std::cos(1e-3)));
    }

    TEST_CASE("gaps of a block that turns by more than a hundredth stay exact") {
        const State stood = twoColumns();
        State state = stood;
        overturn(state, 1, 0.05);
        const State exact = state;
        setIn(state, stood);
        CHECK(stateHash(state) == stateHash(exact));
    }
}
