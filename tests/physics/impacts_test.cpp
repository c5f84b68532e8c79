// Impacts of rocks of any shape: no energy comes of them, and momentum stays.

#include "support/impacts.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "build/build.h"
#include "support/models.h"
#include "talus/simulation.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kNone = 1e-6;  // of the largest kinetic energy: what counts as no gain
// What steps give and take while springs close and open, (omega dt)^2 / 4 at most; 7.5e-5 is the most seen.
constexpr double kOfSteps = 5e-4;

/// The most of what a number of impacts gained.
struct Most {
    double gain = 0, steps = 0, searches = 0, looks = 0, momentum = 0, angular = 0;
    int hit = 0;

    void add(const ImpactGains& gains, bool two_free) {
        const double kinetic = gains.largest_kinetic;
        gain = std::max(gain, gains.above_least / kinetic);
        steps = std::max(steps, gains.steps / kinetic);
        searches = std::max(searches, gains.searches / kinetic);
        looks = std::max(looks, gains.looks / kinetic);
        hit += gains.largest_elastic > 1e-3 * kinetic ? 1 : 0;
        if (!two_free) return;
        momentum = std::max(momentum, gains.momentum_drift);
        angular = std::max(angular, gains.angular_drift);
    }
};

/// Seeds from `first`, as many as asked for. \param restitution  of all joints
void checkImpacts(unsigned first, unsigned count, Rocks rocks = Rocks::convex, double restitution = 1) {
    Most most;
    for (unsigned seed = first; seed < first + count; ++seed) {
        CAPTURE(seed);
        RandomImpact impact = randomImpact(seed, rocks);
        for (Joint& joint : impact.model.joints) joint.restitution_normal = restitution;
        Result<State> state = buildState(keptByCaller(impact.model), false);
        if (!state) continue;  // drawn into each other
        setSpin(*state, impact.spin);
        const ImpactGains gains = runImpact(*state, TakeBack::yes);
        CHECK(gains.above_least < kNone * gains.largest_kinetic);
        most.add(gains, impact.two_free);
    }
    MESSAGE(most.hit << " impacts of " << count << ": largest gain " << most.gain
                     << " of the kinetic energy; before it is taken back by steps " << most.steps
                     << ", by searches " << most.searches << ", by looks " << most.looks << "; momentum "
                     << most.momentum << ", angular momentum " << most.angular);
    CHECK(most.hit >
          (rocks == Rocks::convex ? 0.8 : 0.6) * count);  // bodies are slighter: more fly past each other
    CHECK(most.steps < kOfSteps);
    CHECK(most.searches < 1e-9);
    CHECK(most.looks < 1e-9);
    CHECK(most.momentum < 1e-12);
    CHECK(most.angular < 1e-9);
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("random impacts of rocks gain no energy and keep their momenta") { checkImpacts(1, 60); }
    TEST_CASE("random impacts of bodies gain no energy and keep their momenta") {
        checkImpacts(1, 40, Rocks::bodies);
    }
    TEST_CASE("random impacts with restitution gain no energy and keep their momenta") {
        checkImpacts(1, 30, Rocks::convex, 0.5);
        checkImpacts(1, 20, Rocks::bodies, 0.0);
    }

    TEST_CASE(
        "what is taken back of an impact is what the steps gave: they alone give, and less as they shorten") {
        for (unsigned seed = 1; seed <= 20; ++seed) {
            CAPTURE(seed);
            const RandomImpact impact = randomImpact(seed);
            Result<State> state = buildState(keptByCaller(impact.model), false);
            if (!state) continue;
            setSpin(*state, impact.spin);
            const ImpactGains gains = runImpact(*state, TakeBack::no);
            CHECK(gains.above_least < kOfSteps * gains.largest_kinetic);
            CHECK(gains.searches < 1e-9 * gains.largest_kinetic);
            CHECK(gains.looks < 1e-9 * gains.largest_kinetic);
        }
    }

    TEST_CASE("a rock of eight points that falls on a slope gains nothing in its history, soft or stiff") {
        for (const double stiffness : {1e7, 1e8, 3e8, 1e9, 1e10})
            for (const double damping : {0.0, 5e-4}) {
                CAPTURE(stiffness);
                CAPTURE(damping);
                if (damping > 0 && stiffness > 1e9) continue;  // dashpots that take two minutes of steps
                Model model = rockOverSlope(stiffness, damping, 35);
                model.run.duration = 1.0;
                model.run.frame_interval = 1e-4;
                double most_kinetic = 0, least = kInfinity, gain = 0, most_elastic = 0;
                const auto result = run(model, {.threads = 1}, [&](const HistoryRecord& r) {
                    const double total = r.kinetic_energy + r.elastic_energy + r.gravity_energy;
                    most_kinetic = std::max(most_kinetic, r.kinetic_energy);
                    most_elastic = std::max(most_elastic, r.elastic_energy);
                    gain = std::max(gain, total - least);
                    least = std::min(least, total);
                });
                REQUIRE(result.ok());
                CHECK(most_elastic > 0.1 * most_kinetic);
                CHECK(gain < kNone * most_kinetic);
            }
    }
}

TEST_SUITE("slow: physics") {
    TEST_CASE("a thousand random impacts of rocks gain no energy and keep their momenta") {
        checkImpacts(1, 1000);
    }
    TEST_CASE("a thousand random impacts of bodies gain no energy and keep their momenta") {
        checkImpacts(1, 1000, Rocks::bodies);
    }
}
