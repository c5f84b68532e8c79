#include "search/load_axis.h"

#include <doctest/doctest.h>

#include <cmath>

#include "build/build.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;
using namespace talus::search;

namespace {

Model tilted() {
    Model model = floorModel(30);
    addBox(model, "box", {0, 0, 0}, {1, 1, 0.3});
    model.joints[0].cohesion = 300;
    model.gravity.tilt = radians(12);
    model.seismic.horizontal = 0.05;
    model.analysis.stop = radians(40);
    return model;
}

}  // namespace

TEST_SUITE("search") {
    TEST_CASE("load axes begin at the model's own load, with the analysis' bracket for a cell") {
        Model model = tilted();
        const SearchRules rules;
        const LoadAxis tilt = tiltAxis(model, rules);
        CHECK(tilt.start == radians(12));
        CHECK(tilt.stop == radians(40));
        CHECK(tilt.loading.cell == model.analysis.tolerance);
        CHECK(tilt.longest(0.3) == rules.step_tilt);
        model.analysis.start = radians(-3);
        CHECK(tiltAxis(model, rules).start == radians(-3));

        const LoadAxis strength = strengthAxis(model, rules);
        CHECK(strength.start == 1);
        CHECK(strength.loading.cell == model.analysis.factor_tolerance);
        CHECK(strength.loading.changes_strength);
        CHECK(strength.longest(2) == 2 * rules.step_factor);

        const LoadAxis push = accelerationAxis(model, rules);
        CHECK(push.start == 0.05);
        CHECK(push.loading.cell == model.analysis.acceleration_tolerance);
    }

    TEST_CASE("load axes put their load on a state, and on nothing else") {
        const Model model = tilted();
        State state = *buildState(model, false);
        const Load before = state.load;
        tiltAxis(model, {}).loading.apply(state, 0.3);
        CHECK(state.load.tilt == 0.3);
        CHECK(state.load.horizontal == before.horizontal);
        accelerationAxis(model, {}).loading.apply(state, 0.2);
        CHECK(state.load.horizontal == 0.2);
        weightAxis(1e-4).loading.apply(state, 0.4);
        waterAxis(1e-4).loading.apply(state, 0.7);
        CHECK(state.load.gravity_share == 0.4);
        CHECK(state.load.water_share == 0.7);
        CHECK(state.load.tilt == 0.3);
        CHECK(state.laws[0].tan_friction == doctest::Approx(std::tan(radians(30))));
        strengthAxis(model, {}).loading.apply(state, 2);
        CHECK(state.laws[0].tan_friction == doctest::Approx(std::tan(radians(30)) / 2));
        CHECK(state.laws[0].cohesion == doctest::Approx(150));
    }

    TEST_CASE("load axes say their load for users") {
        const Model model = tilted();
        CHECK(tiltAxis(model, {}).say(radians(19.5)) == "tilt 19.5000 deg");
        CHECK(strengthAxis(model, {}).say(1.25) == "factor 1.2500");
        CHECK(accelerationAxis(model, {}).say(0.125) == "horizontal 0.12500 of the weight");
        CHECK(weightAxis(1e-4).say(0.5) == "50 % of the weight");
    }
}
