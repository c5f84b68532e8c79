// Prescribed motions as sliding or toppling.

#include "failure/failure.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "build/build.h"
#include "step/step.h"
#include "step/time_step.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;
using failure::describeFailure;
using failure::Failure;

namespace {

/// A flat box and a column apart from each other.
State boxAndColumn() {
    Model model = floorModel(30, 1e8);
    addBox(model, "box", {0, 0, 0}, {1, 1, 0.3});
    addBox(model, "column", {3, 0, 0}, {0.3, 1, 1});
    return *buildState(model, false);
}
constexpr std::size_t kBox = 1, kColumn = 2;

void shift(State& state, std::size_t block, const Vec3& by) {
    state.blocks.position.set(block, state.blocks.position.get(block) + by);
}

/// Turns a block about a point by an angle about -y: over its lower edge on the downhill side.
void overturn(State& state, std::size_t block, double angle, const Vec3& about) {
    const Eigen::AngleAxisd turn(-angle, Vec3::UnitY());
    state.blocks.position.set(block, about + turn * (state.blocks.position.get(block) - about));
    const Eigen::Quaterniond q(turn);
    state.blocks.orientation[block] = {q.w(), q.x(), q.y(), q.z()};
}

Failure between(const State& from, const State& to, double deflection = 1e-6) {
    return describeFailure(from.blocks.position, from.blocks.orientation, to, deflection);
}

}  // namespace

TEST_SUITE("failure") {
    TEST_CASE("failure: a block that shifts slides, and the other does not move") {
        const State from = boxAndColumn();
        State to = from;
        shift(to, kBox, {-1e-3, 0, 0});
        const Failure failure = between(from, to);
        CHECK((failure.mode == FailureMode::sliding));
        CHECK(failure.moving_blocks == std::vector<std::string>{"box"});
        REQUIRE(failure.motions.size() == 2);
        CHECK((failure.motions[0].mode == FailureMode::sliding));
        CHECK(failure.motions[0].moving);
        CHECK(failure.motions[0].translation ==
              Vec3(to.blocks.position.get(1) - from.blocks.position.get(1)));
        CHECK(failure.motions[0].rotation_share == 0);
        CHECK_FALSE(failure.motions[1].moving);
        CHECK((failure.motions[1].mode == FailureMode::none));
    }

    TEST_CASE("failure: a column that turns about its lower edge topples") {
        for (const double angle : {1e-4, 1e-3, 1e-2}) {
            CAPTURE(angle);
            const State from = boxAndColumn();
            State to = from;
            overturn(to, kColumn, angle, {3, 0, 0});
            const Failure failure = between(from, to);
            CHECK((failure.mode == FailureMode::toppling));
            CHECK(failure.moving_blocks == std::vector<std::string>{"column"});
            CHECK(failure.motions[1].rotation == doctest::Approx(angle).epsilon(1e-6));
            CHECK(failure.motions[1].rotation_share > 0.4);
            const double arm = std::hypot(0.15, 0.5);
            CHECK(failure.motions[1].translation.norm() == doctest::Approx(arm * angle).epsilon(1e-3));
        }
    }

    TEST_CASE("failure: a column that topples beside a heavier block that slides is mixed") {
        const State from = boxAndColumn();
        State to = from;
        shift(to, kBox, {-1e-3, 0, 0});
        overturn(to, kColumn, 1e-3, {3, 0, 0});
        const Failure failure = between(from, to);
        CHECK((failure.mode == FailureMode::mixed));
        CHECK(failure.moving_blocks == std::vector<std::string>{"box", "column"});
        CHECK((failure.motions[0].mode == FailureMode::sliding));
        CHECK((failure.motions[1].mode == FailureMode::toppling));
    }

    TEST_CASE(
        "failure: blocks displaced by less than joints give, or by a small share of the largest, do not "
        "move") {
        const State from = boxAndColumn();
        State to = from;
        shift(to, kBox, {-1e-3, 0, 0});
        shift(to, kColumn, {-1e-5, 0, 0});
        CHECK(between(from, to).moving_blocks == std::vector<std::string>{"box"});
        CHECK(between(from, to, 1e-3).moving_blocks.empty());
        CHECK((between(from, to, 1e-3).mode == FailureMode::none));
        shift(to, kColumn, {-1e-4, 0, 0});
        CHECK(between(from, to).moving_blocks == std::vector<std::string>{"box", "column"});
    }

    TEST_CASE("failure: the evidence at contacts is what they carry") {
        const State from = boxAndColumn();
        State to = from;
        // Pressed in by 1 um and slid by far more than that: all of the friction is mobilised.
        shift(to, kBox, {-1e-3, 0, -1e-6});
        shift(to, kColumn, {0, 0, 1e-3});
        updateForces(to, false);
        const Failure failure = between(from, to);
        CHECK(failure.motions[0].mobilised_friction == doctest::Approx(1));
        CHECK(failure.motions[0].open_share == 0);
        CHECK(failure.motions[1].open_share == 1);
        CHECK(failure.motions[1].mobilised_friction == 0);
    }

    TEST_CASE(
        "a failure is played on up to the frequency at which small blocks need 1 % of the mass as inertia") {
        Model model = floorModel(30, 1e10);
        addBox(model, "box", {0, 0, 0}, {1, 1, 1});
        addBox(model, "chip", {2, 0, 0}, {0.05, 0.05, 0.02});
        State state = *buildState(model, false);
        const std::vector<double> bounds = frequencyBounds(state, false);
        REQUIRE(bounds[2] > 10 * bounds[1]);
        // The chip has 5e-5 of the mass: slowed down to the box it needs less than a hundredth.
        const double frequency = failure::playedFrequency(state, {0, 1, 1}, false);
        CHECK(frequency == bounds[1]);
        failure::slowDownTo(state, frequency, false);
        CHECK(state.blocks.inverse_mass[1] == doctest::Approx(1 / state.blocks.mass[1]).epsilon(1e-14));
        const double inertia = 1 / state.blocks.inverse_mass[2] - state.blocks.mass[2];
        CHECK(inertia > 0);
        CHECK(inertia <= 0.01 * (state.blocks.mass[1] + state.blocks.mass[2]) * (1 + 1e-9));
        // Where the chip alone moves, the run follows the chip.
        CHECK(failure::playedFrequency(state, {0, 0, 1}, false) == bounds[2]);
    }

    TEST_CASE("rattle damping: half the critical one of the fastest mode, so of stiffer joints less") {
        const auto damping = [](double stiffness) {
            Model model = floorModel(30, stiffness);
            addBox(model, "box", {0, 0, 0}, {1, 1, 0.3});
            const State state = *buildState(model, false);
            return failure::rattleDamping(failure::playedFrequency(state, {0, 1}, false));
        };
        // c = 2 D / omega for dashpots c k; omega^2 >= k A / m, which the bound exceeds by its rotation.
        const double omega = std::sqrt(1e8 / (2700 * 0.3));
        CHECK(damping(1e8) <= 1 / omega);
        CHECK(damping(1e8) > 0.2 / omega);
        CHECK(damping(1e10) == doctest::Approx(0.1 * damping(1e8)).epsilon(1e-6));
    }
}
