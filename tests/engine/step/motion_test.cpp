#include "step/motion.h"

#include <doctest/doctest.h>

#include <random>

#include "build/build.h"
#include "forces/water.h"
#include "measure/measure.h"
#include "simd/instruction_set.h"
#include "state/block_motion.h"
#include "step/step.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;

namespace {

/// One box in empty space, all three inertias different; principal moments in kg m2.
State spinningBox(const Vec3& angular_velocity) {
    Model model;
    model.joints = {joint(30)};
    model.gravity.magnitude = 0;
    model.blocks = {box("body", {0, 0, 0}, {0.3, 0.2, 0.1})};
    State state = *buildState(model, false);
    state.blocks.angular_momentum.set(0, state.blocks.inertia.get(0).cwiseProduct(angular_velocity));
    return state;
}

void fly(State& state, double dt, int steps) { advance(state, {dt, false}, steps); }

/// Distance between the orientations of two states [rad].
double orientationError(const State& a, const State& b) {
    return rotationFrom(a.blocks.orientation, b.blocks.orientation, 0);
}

/// 40 cubes and their floor, everything that moves them random.
State restlessStack() {
    Model model = stackModel(5, 4, 2, 25);
    model.damping = {.mass = 2.0, .rotation = 3.0, .local = 0.3};
    model.waters = {fissureAt(model, 0.4, 0.35)};
    State state = *buildState(model, false);
    updateWater(state);
    std::mt19937 random(5);
    std::normal_distribution<double> gauss(0, 1);
    const auto any = [&]() -> Vec3 { return {gauss(random), gauss(random), gauss(random)}; };
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        state.blocks.velocity.set(b, any());
        state.blocks.angular_momentum.set(b, any());
        state.blocks.force.set(b, 100 * any());
        state.blocks.torque.set(b, 10 * any());
    }
    for (InterfaceWrench& wrench : state.interfaces.wrenches) wrench = {any(), any(), any()};
    updateSpin(state, {0, state.blocks.size()});
    return state;
}

using Stage = void (*)(State&, Range, double);
void gatherThenDrift(State& state, Range range, double dt) {
    gather(state, range, dt);
    drift(state, range, dt);
}

bool sameBlock(const Blocks& a, const Blocks& b, std::size_t i) {
    const auto same = [&](const VectorArray& x, const VectorArray& y) { return x.get(i) == y.get(i); };
    return a.position[i] == b.position[i] && a.orientation[i] == b.orientation[i] &&
           same(a.velocity, b.velocity) && same(a.angular_momentum, b.angular_momentum) &&
           same(a.force, b.force) && same(a.torque, b.torque) && same(a.angular_velocity, b.angular_velocity);
}

}  // namespace

TEST_SUITE("step") {
    TEST_CASE(
        "drift and gather of any piece of the blocks, by every build: the same bits, nothing beside it") {
        constexpr double kStep = 1e-3;
        const State start = restlessStack();
        const std::size_t n = start.blocks.size();
        for (const auto& [stage, plain] :
             {std::pair<Stage, Stage>{drift, drift}, {gather, gather}, {gatherAndDrift, gatherThenDrift}}) {
            State expected = start;  // block by block, without registers of several
            expected.instructions = simd::InstructionSet::scalar;
            for (std::size_t b = 0; b < n; ++b) plain(expected, {b, b + 1}, kStep);
            for (const auto set :
                 {simd::InstructionSet::scalar, simd::InstructionSet::avx2, simd::InstructionSet::avx512}) {
                if (!simd::isAvailable(set)) continue;
                for (const std::size_t begin : {std::size_t{0}, std::size_t{3}})
                    for (std::size_t end = begin; end <= n; ++end) {
                        State moved = start;
                        moved.instructions = set;
                        stage(moved, {begin, end}, kStep);
                        std::size_t right = 0;
                        for (std::size_t b = 0; b < n; ++b) {
                            const bool inside = b >= begin && b < end;
                            right += sameBlock(moved.blocks, inside ? expected.blocks : start.blocks, b);
                        }
                        CHECK(right == n);
                    }
            }
        }
    }

    TEST_CASE("steps taken at once or one by one: the same bits, and each has its own load") {
        Model model = stackModel(4, 5, 1, 19.5);
        model.waters = {fissureAt(model, 0.4, 0.35)};
        model.damping.local = 0.2;
        State together = *buildState(model, false);
        updateForces(together, false);
        State apart = together;
        const auto tiltAt = [](int k) { return radians(5 + k); };
        for (int round = 0; round < 3; ++round) {
            int loads = 0;
            advance(together, {1e-5, false}, 7, [&](int k) {
                CHECK(k == loads++);
                together.load.tilt = tiltAt(k);
            });
            CHECK(loads == 7);
            for (int k = 0; k < 7; ++k) {
                apart.load.tilt = tiltAt(k);
                advance(apart, {1e-5, false});
            }
            CHECK(stateHash(together) == stateHash(apart));
            CHECK(together.step == apart.step);
        }
        advance(together, {1e-5, false}, 0);
        CHECK(stateHash(together) == stateHash(apart));
    }

    TEST_CASE("a spinning box keeps its energy and momentum over 1000 turns") {
        State state = spinningBox({0.3, 6.0, 0.2});  // near the unstable axis: it tumbles
        const Vec3 momentum = state.blocks.angular_momentum.get(0);
        const double energy = kineticEnergy(state);
        const double dt = 0.005;  // about 200 steps a turn
        double most = 0;
        for (int k = 0; k < 1000; ++k) {
            fly(state, dt, 210);
            most = std::max(most, std::abs(kineticEnergy(state) / energy - 1));
        }
        MESSAGE("energy error over 1000 turns: " << most);
        CHECK(most < 2e-3);  // bounded, no drift: see the order below
        CHECK((state.blocks.angular_momentum.get(0) - momentum).norm() < 1e-12 * momentum.norm());
    }

    TEST_CASE("rotation is of second order") {
        const auto errorAt = [](int steps) {
            State coarse = spinningBox({2, 6, 3}), fine = spinningBox({2, 6, 3});
            fly(coarse, 1.0 / steps, steps);
            fly(fine, 1.0 / 64000, 64000);
            return orientationError(coarse, fine);
        };
        const double ratio = errorAt(500) / errorAt(1000);
        MESSAGE("halving the step divides the error by " << ratio);
        CHECK(ratio == doctest::Approx(4).epsilon(0.03));
    }

    TEST_CASE("translation in a spring is of second order and keeps its energy") {
        // A cube released 0.1 mm deep in the floor would leave it; a bonded joint holds it as a spring.
        const auto swing = [](int steps, double& energy_error) {
            Model model = floorModel(30, 1e8);
            // Cohesion, too: without it the last bit of shear would break a joint in tension.
            model.joints[0].tensile_strength = model.joints[0].cohesion = 1e12;
            model.gravity.magnitude = 0;
            addBox(model, "cube", {0, 0, 0}, {1, 1, 1}, 1000);
            State state = *buildState(model, false);
            state.blocks.position[1].z += 1e-4;
            updateForces(state, false);
            const double energy = elasticEnergy(state);
            const double duration = 0.02;  // omega = sqrt(1e8 / 1000) = 316 rad/s, one turn
            energy_error = 0;
            for (int k = 0; k < steps; ++k) {
                advance(state, {duration / steps, false});
                const double now = elasticEnergy(state) + kineticEnergy(state);
                energy_error = std::max(energy_error, std::abs(now / energy - 1));
            }
            return state.blocks.position[1].z - 0.5 - 1e-4 * std::cos(std::sqrt(1e5) * duration);
        };
        double coarse_energy = 0, fine_energy = 0;
        const double coarse = swing(100, coarse_energy), fine = swing(200, fine_energy);
        CHECK(coarse / fine == doctest::Approx(4).epsilon(0.05));
        CHECK(coarse_energy / fine_energy == doctest::Approx(4).epsilon(0.05));
        CHECK(fine_energy < 3e-4);
    }

    TEST_CASE("free fall, with and without drag") {
        Model model;
        model.joints = {joint(30)};
        model.gravity.tilt = radians(30);
        model.blocks = {box("body", {0, 0, 0}, {1, 1, 1})};
        State state = *buildState(model, false);
        updateForces(state, false);
        fly(state, 1e-3, 1000);
        CHECK(state.blocks.velocity.get(0).x() == doctest::Approx(-9.81 * 0.5));
        CHECK(state.blocks.position.get(0).z() == doctest::Approx(0.5 - 0.5 * 9.81 * std::cos(M_PI / 6)));
        State dragged = *buildState(model, false);
        dragged.damping.mass = 2.0;
        updateForces(dragged, false);
        fly(dragged, 1e-3, 1000);  // v = g/c (1 - exp(-c t))
        CHECK(dragged.blocks.velocity.get(0).x() ==
              doctest::Approx(-9.81 * 0.5 / 2 * (1 - std::exp(-2.0))).epsilon(1e-6));
    }

    TEST_CASE("c_I slows the rotation, c_m does not") {
        State state = spinningBox({0, 0, 5});
        state.damping.rotation = 0.5;
        fly(state, 1e-3, 2000);
        CHECK(state.blocks.angular_momentum.get(0).z() ==
              doctest::Approx(5 * state.blocks.inertia.z[0] * std::exp(-1.0)));
        State other = spinningBox({0, 0, 5});
        other.damping.mass = 0.5;
        fly(other, 1e-3, 2000);
        CHECK(other.blocks.angular_momentum.get(0).z() == doctest::Approx(5 * other.blocks.inertia.z[0]));
    }

    TEST_CASE("local damping takes its share of the force when it moves, and gives none at rest") {
        Model model;
        model.joints = {joint(30)};
        model.damping.local = 0.8;
        model.blocks = {box("body", {0, 0, 0}, {1, 1, 1})};
        State state = *buildState(model, false);
        state.blocks.velocity.z[0] = -1;
        updateForces(state, false);
        CHECK(state.blocks.force.z[0] == doctest::Approx(-0.2 * 2700 * 9.81));
        state.blocks.velocity.z[0] = 1;
        updateForces(state, false);
        CHECK(state.blocks.force.z[0] == doctest::Approx(-1.8 * 2700 * 9.81));
        state.blocks.velocity.z[0] = 0;
        updateForces(state, false);
        CHECK(state.blocks.force.z[0] == doctest::Approx(-2700 * 9.81));
    }

    TEST_CASE("driven blocks keep their velocity, fixed ones their place") {
        Model model = floorModel(30);
        model.blocks.push_back(box("driven", {0, 0, 1}, {1, 1, 2}, 2700, Motion::driven));
        model.blocks[1].velocity = {0.1, 0, 0};
        State state = *buildState(model, false);
        updateForces(state, false);
        fly(state, 1e-3, 100);
        CHECK(state.blocks.position[1].x == doctest::Approx(0.5 + 0.01));
        CHECK(state.blocks.velocity.x[1] == 0.1);
        CHECK(state.blocks.position.get(0) == state.geometry->initial_position.get(0));
    }
}
