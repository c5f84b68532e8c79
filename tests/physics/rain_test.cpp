// Rain into a crack that leaks through its foot: the exact filling curve, the balance of mass, an aperture
// that follows the walls.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "build/build.h"
#include "forces/closed_water.h"
#include "forces/leak.h"
#include "forces/water.h"
#include "model/over_time.h"
#include "support/closed_fissure.h"
#include "support/relative.h"
#include "talus/formats/scenario.h"
#include "talus/simulation.h"
#include "talus/storm.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kMillimetrePerHour = 1 / 3.6e6;  // [m/s]

/// The fissure of a block that stands, with rain and a leak.
struct RainyFissure {
    ClosedFissure fissure{};
    double intensity = 40 * kMillimetrePerHour;  ///< [m/s]
    double catchment = 0.04, leak_length = 5;    ///< [m]
    double aperture = 2e-4;                      ///< [m]

    RainyFissure() {
        fissure.tilt_deg = 5;
        fissure.filled = 0;
    }

    Model model() const {
        Model made = fissure.model(1e10);
        Water& water = made.waters[0];
        water.rain = {{0, intensity}};
        water.catchment = catchment;
        water.leak_aperture = aperture;
        water.leak_length = leak_length;
        return made;
    }

    /// a of dH/dt = (i C - a H) / b: the leak's discharge per metre of level [m/s].
    double leakPerLevel() const {
        const double unit_weight = fissure.water_density * fissure.g;
        return unit_weight * std::pow(aperture, 3) / (12 * kWaterViscosity) * std::cos(fissure.tilt()) /
               leak_length;
    }

    double highest() const { return intensity * catchment / leakPerLevel(); }
    double levelAfter(double time) const {
        return highest() * (1 - std::exp(-leakPerLevel() * time / fissure.opening));
    }
};

State begun(const Model& model) {
    State state = *buildState(model, false);
    beginClosedWater(state);
    return state;
}

void goTo(State& state, double time) {
    state.load.time = time;
    updateWater(state);
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("rain: a crack fills along H = i C / a (1 - exp(-a t / b)), whatever the step") {
        const RainyFissure rainy;
        REQUIRE(rainy.highest() < rainy.fissure.height);
        for (const double step : {1.0, 30.0, 300.0}) {
            CAPTURE(step);
            State state = begun(rainy.model());
            for (double time = step; time <= 3600; time += step) goTo(state, time);
            CHECK(state.closed.level[0] == near(rainy.levelAfter(3600), 1e-9));
        }
        CHECK(rainy.levelAfter(3600) > 0.5 * rainy.highest());
    }

    TEST_CASE("rain: after it the level falls exponentially") {
        RainyFissure rainy;
        rainy.intensity = 0;
        rainy.fissure.filled = 0.35;
        State state = begun(rainy.model());
        for (const double time : {10.0, 400.0, 4000.0}) {
            goTo(state, time);
            CHECK(state.closed.level[0] ==
                  near(0.35 * std::exp(-rainy.leakPerLevel() * time / rainy.fissure.opening), 1e-9));
        }
    }

    TEST_CASE("rain: what came in is in the crack, has leaked or has run over") {
        RainyFissure rainy;
        rainy.intensity = 400 * kMillimetrePerHour;
        Model model = rainy.model();
        Water& water = model.waters[0];
        water.rain = {{0, 0}, {600, rainy.intensity}, {1800, rainy.intensity}, {1900, 0}};
        water.inflow = {{0, 1e-7}, {500, 0}};
        State state = begun(model);
        const double width = state.closed.width[0];
        for (double time = 20; time <= 4000; time += 20) {
            goTo(state, time);
            const double in = width * (rainy.catchment * integralOver(water.rain, 0, time) +
                                       integralOver(water.inflow, 0, time));
            CAPTURE(time);
            CHECK(state.closed.volume[0] + state.closed.leaked[0] + state.closed.run_over[0] ==
                  near(in, 1e-12));
        }
        CHECK(state.closed.run_over[0] > 0);
        CHECK(state.closed.leaked[0] > 0);
        CHECK(closedWaterReports(state)[0].leaked == state.closed.leaked[0]);
    }

    TEST_CASE("rain: a leak follows what the walls part at their foot, and shuts where they close") {
        RainyFissure rainy;
        rainy.intensity = 0;
        rainy.fissure.filled = 0.35;
        const auto leakedWith = [&](double parted) {
            State state = begun(rainy.model());
            state.blocks.position.set(1, state.blocks.position.get(1) + Vec3(-parted, 0, 0));
            updateWater(state);  // the level falls by what the fissure is wider
            const double level = state.closed.level[0];
            goTo(state, 1e-3);
            return state.closed.leaked[0] / level;
        };
        const double before = leakedWith(0);
        CHECK(before > 0);
        CHECK(leakedWith(2e-4) == near(8 * before, 1e-3));  // twice the aperture
        CHECK(leakedWith(-1e-4) == near(before / 8, 1e-3));
        CHECK(leakedWith(-2e-4) < 1e-9 * before);
        CHECK(leakedWith(-3e-4) == 0);
    }

    TEST_CASE("rain: a history fills the crack likewise, with the same bits by one thread and by two") {
        RainyFissure rainy;
        rainy.fissure.tilt_deg = 5;
        rainy.aperture = 2e-3;  // quick enough for a history
        rainy.intensity = 1e6 * kMillimetrePerHour;
        Model model = rainy.model();
        model.blocks[1].motion = Motion::fixed;  // a fissure of rigid walls
        model.run.duration = 0.02;
        model.run.frame_interval = 0.005;
        model.run.time_step = 1e-5;
        Control two;
        two.threads = 2;
        const auto one = run(model, {}, RunOutput{}), other = run(model, two, RunOutput{});
        REQUIRE(one.ok());
        REQUIRE(other.ok());
        CHECK(one->waters[0].level == near(rainy.levelAfter(one->simulated_seconds), 1e-9));
        CHECK(one->waters[0].leaked > 0);
        CHECK(one->waters[0].level == other->waters[0].level);
        CHECK(one->waters[0].leaked == other->waters[0].leaked);
        CHECK(one->state_hash == other->state_hash);
    }

    TEST_CASE("rain: the block of the guide has the factors of limit equilibrium all day") {
        const auto scenario = formats::readScenario(TALUS_SOURCE_DIR "/bench/examples/rain.toml");
        REQUIRE(scenario.ok());
        const auto result = storm(scenario->model, {.step = 7200});
        REQUIRE(result.ok());
        // The plane of 30 degrees through the toe, the crack at x = 12 m, the face up to (6.93, 12).
        const double dip = radians(30), foot = 12 * std::tan(dip), crest = 6.93;
        const double area = 0.5 * (crest * 12 + (12 - crest) * 24) - 0.5 * 12 * foot;
        const double weight = area * 2650 * 9.81, tan_phi = std::tan(radians(33));
        for (const StormPoint& point : result->points) {
            CAPTURE(point.time);
            const double depth = point.levels[0] - foot, thrust = 0.5 * 9810 * depth * depth;
            const double exact = (weight * std::cos(dip) - thrust * std::sin(dip)) * tan_phi /
                                 (weight * std::sin(dip) + thrust * std::cos(dip));
            CHECK(point.factor == doctest::Approx(exact).epsilon(0.002));
        }
        CHECK(result->failure_time);
    }
}
