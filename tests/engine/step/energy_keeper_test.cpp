// Energy taken from relative motion of blocks: the given amount, without momentum.

#include "step/energy_keeper.h"

#include <doctest/doctest.h>

#include "build/build.h"
#include "measure/measure.h"
#include "step/relative_motion.h"
#include "step/step.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;

namespace {

/// Two free boxes, the upper one pressed a little into the lower, that move against each other.
State pressedBoxes() {
    Model model;
    model.joints = {joint(30, 1e9)};
    model.gravity.magnitude = 0;
    addBox(model, "lower", {0, 0, 0}, {0.4, 0.4, 0.2});
    addBox(model, "upper", {0.1, 0.1, 0.2}, {0.2, 0.2, 0.2});
    State state = *buildState(std::move(model), false);
    state.blocks.position.set(1, state.blocks.position.get(1) - Vec3(0, 0, 1e-5));
    state.blocks.velocity.set(0, {0.1, 0.2, 0.3});
    state.blocks.velocity.set(1, {-0.5, 0.4, -1.0});
    state.blocks.angular_momentum.set(1, {0.02, -0.01, 0.03});
    updateForces(state, false);
    return state;
}

struct Momenta {
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};

Momenta momentaOf(const State& state) {
    Momenta sum;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        const Vec3 p = state.blocks.velocity.get(b) / state.blocks.inverse_mass[b];
        sum.linear += p;
        sum.angular += state.blocks.position.get(b).cross(p) + state.blocks.angular_momentum.get(b);
    }
    return sum;
}

}  // namespace

TEST_SUITE("engine/step") {
    TEST_CASE("an impulse takes the given energy, and conserves both momenta") {
        State state = pressedBoxes();
        const Momenta before = momentaOf(state);
        const double kinetic = kineticEnergy(state);
        const DeepestPoint deepest = deepestPoint(state, 0);
        const RelativeMotion motion = motionAt(state, 0, deepest.place);
        CHECK(deepest.depth == doctest::Approx(1e-5));
        REQUIRE(motion.energy() > 0);
        REQUIRE(motion.energy() < kinetic);
        for (const double share : {1e-9, 0.1, 0.9}) {
            State pushed = state;
            takeEnergy(pushed, 0, deepest.place, motion, share * motion.energy());
            CHECK(kinetic - kineticEnergy(pushed) == doctest::Approx(share * motion.energy()).epsilon(1e-6));
            CHECK((momentaOf(pushed).linear - before.linear).norm() < 1e-13 * before.linear.norm());
            CHECK((momentaOf(pushed).angular - before.angular).norm() < 1e-13 * before.linear.norm());
        }
    }

    TEST_CASE("what the steps gave is taken back, at most half of what moves; of a loss nothing") {
        State state = pressedBoxes();
        CHECK(isLeftAlone(state));
        const double total = totalEnergy(state, false);
        CHECK(total == kineticEnergy(state) + gravityEnergy(state) + elasticEnergy(state));
        const double moving = motionAt(state, 0, deepestPoint(state, 0).place).energy();
        takeBack(state, -1.0, 1e-6, false);
        CHECK(totalEnergy(state, false) == total);
        takeBack(state, 1e-3 * moving, 1e-6, false);
        CHECK(totalEnergy(state, false) == doctest::Approx(total - 1e-3 * moving).epsilon(1e-13));
        takeBack(state, 1e6 * moving, 1e-6, false);
        CHECK(totalEnergy(state, false) > 0.5 * elasticEnergy(state));
        CHECK(totalEnergy(state, false) > total - moving);
    }

    TEST_CASE("blocks that are apart give nothing back") {
        State state = pressedBoxes();
        state.blocks.position.set(1, state.blocks.position.get(1) + Vec3(0, 0, 0.01));
        const double kinetic = kineticEnergy(state);
        takeBack(state, 0.1 * kinetic, 1e-4, false);
        CHECK(kineticEnergy(state) == kinetic);
    }
}
