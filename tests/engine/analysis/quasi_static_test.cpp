// A motion that was left undecided and is gone on with is the motion that would have been: in as many steps, to the same bits.

#include "analysis/quasi_static.h"

#include <doctest/doctest.h>

#include "build/build.h"
#include "measure/measure.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;
using namespace talus::analysis;

namespace {

struct Case {
    const char* name;
    double friction_deg, tilt_deg, cohesion, residual_cohesion;
    int columns, rows;
    Verdict verdict;
};

constexpr Case kCases[] = {
    {"stands", 30, 20, 0, 0, 2, 3, Verdict::stable},
    {"slides", 19.5, 22, 0, 0, 2, 3, Verdict::failing},
    {"slides near its limit", 19.5, 19.55, 0, 0, 3, 2, Verdict::failing},
    {"topples", 40, 14, 0, 0, 1, 10, Verdict::failing},
    {"is held by whole bonds", 20, 30, 1e5, 0, 1, 2, Verdict::stable},
    {"breaks its bonds once it has come to rest on them", 20, 30, 600, 0, 1, 2, Verdict::failing},
};

struct Brought {
    State state;
    Probe probe;
};

Model modelOf(const Case& of) {
    Model model = stackModel(of.columns, of.rows, 1, of.friction_deg);
    model.joints[0].cohesion = of.cohesion;
    model.joints[0].residual_cohesion = of.residual_cohesion;
    return model;
}

/// Weight and tilt brought on at once. \param most_steps  of each part; what is left open is gone on with
Brought bringOnInParts(const Model& model, double tilt_deg, std::int64_t most_steps, int& parts) {
    Brought brought{*buildState(model, false), {}};
    const Control control;
    QuasiStaticWork work = prepare(brought.state, {}, control, 1e-4, false);
    work.settings.max_steps_per_probe = most_steps;
    std::optional<Watched> open;
    const Ramp ramp = [&](State& state, double share) { state.load.tilt = share * radians(tilt_deg); };
    Probe probe = bringOn(brought.state, work, ramp, &open);
    std::int64_t steps = probe.steps;
    for (parts = 1; probe.verdict == Verdict::undecided && parts < 1000; ++parts) {
        REQUIRE(open.has_value());
        probe = goOn(brought.state, work, *open);
        steps += probe.steps;
    }
    probe.steps = steps;
    brought.probe = probe;
    return brought;
}

}  // namespace

TEST_SUITE("analysis") {
    TEST_CASE("a motion left undecided is gone on with as if it had not been left") {
        for (const Case& of : kCases) {
            CAPTURE(of.name);
            const Model model = modelOf(of);
            int parts = 0;
            const Brought whole = bringOnInParts(model, of.tilt_deg, 400'000, parts);
            REQUIRE((whole.probe.verdict == of.verdict));
            CHECK(parts == 1);
            bool any_in_parts = false;
            // Looks for what has left its place are every 100 steps.
            for (const std::int64_t most_steps : {300, 700, 1'900}) {
                CAPTURE(most_steps);
                const Brought found = bringOnInParts(model, of.tilt_deg, most_steps, parts);
                any_in_parts = any_in_parts || parts > 1;
                CHECK((found.probe.verdict == whole.probe.verdict));
                CHECK(found.probe.steps == whole.probe.steps);
                CHECK(found.probe.displacement == whole.probe.displacement);
                CHECK(found.probe.out_of_balance == whole.probe.out_of_balance);
                CHECK(stateHash(found.state) == stateHash(whole.state));
            }
            CHECK(any_in_parts);
        }
    }

    TEST_CASE("what was decided leaves nothing open") {
        State state = *buildState(stackModel(1, 2, 1, 30), false);
        const Control control;
        QuasiStaticWork work = prepare(state, {}, control, 1e-4, false);
        std::optional<Watched> open;
        const Probe probe = bringOn(
            state, work, [](State&, double) {}, &open);
        CHECK((probe.verdict == Verdict::stable));
        CHECK_FALSE(open.has_value());
    }
}
