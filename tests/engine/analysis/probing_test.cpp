// What a search takes for a rest nearby, and for how far the assembly has come.

#include "analysis/probing.h"

#include <doctest/doctest.h>

#include "analysis/load_start.h"
#include "build/build.h"
#include "state/block_motion.h"
#include "step/step.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;
using namespace talus::analysis;

namespace {

LoadAxis tiltAxis() {
    LoadAxis axis;
    axis.stop = 100;
    axis.cell = radians(0.1);
    axis.imbalance_tolerance = 1e-3;
    axis.next = [](std::int64_t cell) { return cell + 1; };
    axis.apply = [](State& state, double tilt) { state.load.tilt = tilt; };
    axis.say = [](double) { return std::string(); };
    return axis;
}

double wayBetween(const State& from, const State& to) {
    return largestMotion(to, from.blocks.position, from.blocks.orientation);
}

/// Slid down a tilted floor by some way and stopped there, on level ground again.
State slidBy(const Probing& probing, double way) {
    State state = probing.last_stable;
    state.load.tilt = radians(40);
    while (wayBetween(probing.last_stable, state) < way) advance(state, {probing.work.time_step, false}, 1);
    state.load.tilt = 0;
    setAtRest(state.blocks);
    return state;
}

}  // namespace

TEST_SUITE("analysis") {
    TEST_CASE(
        "a rest counts from where the assembly last stood, however far an earlier part of the probe has "
        "come") {
        for (const double stiffness : {1e8, 1e9, 1e10}) {
            CAPTURE(stiffness);
            Model model = floorModel(20, stiffness);
            addBox(model, "box", {0, 0, 0}, {1, 1, 0.3}, 2700);
            const LoadAxis axis = tiltAxis();
            const Control control;
            Probing probing = beginProbing(*buildState(model, false), axis, control, {}, false);
            REQUIRE((loadGravityAndWater(probing, [] { return false; }) == Verdict::stable));
            const double settled = 2700 * 9.81 * 0.3 / stiffness;
            CHECK(probing.settlement == doctest::Approx(settled).epsilon(0.01));
            CHECK(probing.deflection == probing.settlement);

            // Within 2e-4 of its size: it stands there, and has come all that way.
            const State before = probing.last_stable;
            const State moved = slidBy(probing, 1e-4);
            REQUIRE(settles(probing, moved, 0));
            const double way = wayBetween(before, probing.last_stable);
            CHECK(way > 4e-5);
            CHECK(probing.deflection == doctest::Approx(probing.settlement + way));
            CHECK_FALSE(probing.stands_elsewhere);

            // Farther than 1.5 times what it has come: it has failed, and stands where it stood.
            const State stood = probing.last_stable;
            const double deflection = probing.deflection;
            CHECK_FALSE(settles(probing, slidBy(probing, 3e-3), 0));
            CHECK(probing.stands_elsewhere);
            CHECK(probing.deflection == deflection);
            CHECK(wayBetween(stood, probing.last_stable) == 0);
            CHECK((probing.probes.back().verdict == Verdict::failing));
        }
    }
}
