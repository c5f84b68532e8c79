// Stable assemblies must not move: the known failures of other engines.

#include <doctest/doctest.h>

#include "build/build.h"
#include "history/quasi_static.h"
#include "measure/measure.h"
#include "step/step.h"
#include "step/time_step.h"
#include "support/models.h"
#include "talus/formats/scenario.h"
#include "talus/simulation.h"

using namespace talus;
using namespace talus::test;

namespace {

struct Settled {
    State state;
    double dt = 0;
};

/// Gravity applied at once, vibration damped by drag and dashpots.
Settled settled(const Model& model, double seconds) {
    Settled result{*buildState(model, false)};
    const std::vector<double> bounds = frequencyBounds(result.state, false);
    result.dt = 0.5 * stableTimeStep(*std::max_element(bounds.begin(), bounds.end()), model.damping.contact);
    updateForces(result.state, false);
    for (double t = 0; t < seconds; t += result.dt) advance(result.state, {result.dt, false});
    return result;
}

void run(Settled& s, double seconds) {
    for (double t = 0; t < seconds; t += s.dt) advance(s.state, {s.dt, false});
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("a block on a 20 deg slope with phi 21 does not creep, nor mind a far neighbour") {
        Model model = floorModel(21, 1e9);
        model.gravity.tilt = radians(20);
        model.damping.contact = 1e-4;
        addBox(model, "block", {0, 0, 0}, {1, 1, 0.5});
        Settled alone = settled(model, 1.0);
        addBox(model, "far", {15, 0, 0}, {1, 1, 0.5});
        Settled both{*buildState(model, false), alone.dt};
        updateForces(both.state, false);
        while (both.state.step < alone.state.step) advance(both.state, {both.dt, false});
        CHECK(both.state.blocks.position.get(1) == alone.state.blocks.position.get(1));

        const Vec3 before = alone.state.blocks.position.get(1);
        run(alone, 1.0);
        CHECK((alone.state.blocks.position.get(1) - before).norm() < 1e-12);
    }

    TEST_CASE("the out-of-balance force of a stack at rest decays, it does not plateau") {
        Model model = stackModel(3, 4, 1, 30, {0.2, 0.1, 0.1}, 1e9);
        model.gravity.tilt = radians(10);
        model.damping.local = 0.5;
        const Settled s = settled(model, 0.5);
        MESSAGE("out-of-balance force over weight: " << outOfBalanceRatio(s.state));
        CHECK(outOfBalanceRatio(s.state) < 1e-6);
    }

    TEST_CASE(
        "a wedge of 32 blocks in a valley comes to rest: its out-of-balance force decays by far more than "
        "1e-6") {
        // A prism, apex down, between two fixed flanks; cut into slabs, and each slab upright and flat.
        const auto scenario = formats::parseScenario(
            "[material.rock]\ndensity = 2700.0\n"
            "[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 35.0\n"
            "[rock_mass]\nregion = { profile = [[0, 0], [2, 2], [-2, 2]], y = [0, 8] }\n"
            "[[joint_set]]\nname = \"slabs\"\ndip_deg = 90\ndip_direction_deg = 0\nspacing = 1.0\n"
            "[[single_joint]]\nname = \"upright\"\npoint = [0, 4, 1]\ndip_deg = 90\ndip_direction_deg = 90\n"
            "[[single_joint]]\nname = \"flat\"\npoint = [0, 4, 1]\ndip_deg = 0\ndip_direction_deg = 90\n"
            "[[block]]\nname = \"east\"\nfixed = true\n"
            "vertices = [[0,0,0],[3,0,3],[3,0,0],[0,8,0],[3,8,3],[3,8,0]]\n"
            "[[block]]\nname = \"west\"\nfixed = true\n"
            "vertices = [[0,0,0],[-3,0,3],[-3,0,0],[0,8,0],[-3,8,3],[-3,8,0]]\n",
            "wedge.toml");
        REQUIRE(scenario.ok());
        State state = *buildState(scenario->model, false);
        REQUIRE(state.blocks.size() == 2 + 32);
        updateForces(state, false);
        const double start = outOfBalanceRatio(state);
        const Control control;
        auto work = history::prepare(state, {}, control, 1e-8, false);
        const history::Settling settling = history::bringOn(state, work, [](State&, double) {});
        MESSAGE("out-of-balance force over weight: " << start << ", then " << settling.out_of_balance
                                                     << " after " << settling.steps << " steps");
        CHECK(start == doctest::Approx(1));
        CHECK((settling.verdict == Verdict::stable));
        CHECK(settling.out_of_balance < 1e-9);
    }

    TEST_CASE("an undamped stack keeps its energy while its contacts stay closed") {
        Model model = floorModel(40, 1e9);
        model.joints[0].cohesion = model.joints[0].tensile_strength = 1e12;
        for (int r = 0; r < 4; ++r) addBox(model, "b" + std::to_string(r), {0, 0, 0.1 * r}, {0.2, 0.1, 0.1});
        State state = *buildState(model, false);
        const std::vector<double> bounds = frequencyBounds(state, false);
        const double dt = 0.1 * stableTimeStep(*std::max_element(bounds.begin(), bounds.end()), 0);
        updateForces(state, false);
        double most = 0, kinetic = 0;
        for (int k = 0; k < 200'000; ++k) {
            advance(state, {dt, false});
            if (k % 100 != 0) continue;
            const double t = kineticEnergy(state);
            most = std::max(most, std::abs(t + elasticEnergy(state) + gravityEnergy(state)));
            kinetic = std::max(kinetic, t);
        }
        MESSAGE("energy error over the largest kinetic energy: " << most / kinetic);
        CHECK(most < 0.01 * kinetic);
    }
}

TEST_SUITE("slow: physics") {
    TEST_CASE("a stack of 20 blocks does not creep in 10 s") {
        Model model = floorModel(30, 1e9);  // at 1e8 Pa/m a tower of 2 m on a 0.1 m base buckles
        model.damping.mass = 2.0;
        model.damping.contact = 1e-4;
        for (int r = 0; r < 20; ++r) addBox(model, "b" + std::to_string(r), {0, 0, 0.1 * r}, {0.2, 0.1, 0.1});
        Settled s = settled(model, 12.0);
        std::vector<Vec3> before;
        for (std::size_t b = 1; b <= 20; ++b) before.push_back(s.state.blocks.position.get(b));
        run(s, 10.0);
        double most = 0;
        for (std::size_t b = 1; b <= 20; ++b)
            most = std::max(most, (s.state.blocks.position.get(b) - before[b - 1]).norm());
        MESSAGE("creep in 10 s: " << most << " m");
        CHECK(most < 1e-9);
    }
}
