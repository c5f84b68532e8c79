#include "equilibrium/first_order_gaps.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "build/build.h"
#include "equilibrium/find_equilibrium.h"
#include "forces/contact_forces.h"
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

}  // namespace

TEST_SUITE("equilibrium") {
    TEST_CASE(
        "columns that turn together press the joint between them by w (1 - cos t), and not to first order") {
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

            const FirstOrderGaps gaps(stood, state);
            const double weight = 2700 * kWidth * 0.1 * kHeight * 9.81;
            CHECK(gaps.share(state) ==
                  doctest::Approx(3.375e11 * 0.1 * kHeight * pressed / weight).epsilon(2e-3));
            gaps.set(state);
            CHECK(gapsAt(state, i, kHeight).cwiseAbs().maxCoeff() < 1e-3 * pressed + 1e-15);
        }
    }

    TEST_CASE("one column that overturns opens the joint behind it by its height times the angle") {
        const double angle = 1e-3;
        const State stood = twoColumns();
        const std::size_t i = jointBetween(stood);
        State state = stood;
        overturn(state, 1, angle);
        FirstOrderGaps(stood, state).set(state);
        const Vec2 gaps = gapsAt(state, i, kHeight);
        CHECK(std::abs(gaps.x()) < kWidth * angle * angle);
        CHECK(gaps.y() == doctest::Approx(kHeight * angle).epsilon(1e-6));
    }

    TEST_CASE("what only shifts has the gaps that it has") {
        const State stood = twoColumns();
        State state = stood;
        state.blocks.position.set(2, state.blocks.position.get(2) + Vec3(1e-3, 2e-3, 3e-3));
        CHECK(FirstOrderGaps(stood, state).share(state) < 1e-9);
        const Vec2 before = gapsAt(state, jointBetween(state), kHeight);
        FirstOrderGaps(stood, state).set(state);
        CHECK((gapsAt(state, jointBetween(state), kHeight) - before).norm() < 1e-15);
    }

    TEST_CASE(
        "equal columns stand jammed beyond the tilt at which each overturns; to first order they do not") {
        for (const int columns : {2, 3, 5}) {
            CAPTURE(columns);
            State stood = *buildState(stackModel(columns, 1, 1, 40, {kWidth, 0.1, kHeight}), false);
            REQUIRE((equilibrium::findEquilibrium(stood, {}).verdict == Verdict::stable));
            stood.load.tilt = 0.99 * std::atan(kWidth / kHeight);
            REQUIRE((equilibrium::findEquilibrium(stood, {}).verdict == Verdict::stable));
            State first_order = stood;
            first_order.load.tilt = stood.load.tilt;
            CHECK((equilibrium::findEquilibrium(first_order, {.stood = &stood}).verdict == Verdict::stable));
            first_order.load.tilt = 1.01 * std::atan(kWidth / kHeight);
            CHECK((equilibrium::findEquilibrium(first_order, {.stood = &stood}).verdict != Verdict::stable));
            State exact = stood;
            exact.load.tilt = first_order.load.tilt;
            CHECK((equilibrium::findEquilibrium(exact, {}).verdict == Verdict::stable));
        }
    }
}
