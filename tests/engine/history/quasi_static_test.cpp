// A slowly applied load: stable assemblies reach equilibrium, failures are found.

#include "history/quasi_static.h"

#include <doctest/doctest.h>

#include "build/build.h"
#include "measure/measure.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;
using namespace talus::history;

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

Model modelOf(const Case& of) {
    Model model = stackModel(of.columns, of.rows, 1, of.friction_deg);
    model.joints[0].cohesion = of.cohesion;
    model.joints[0].residual_cohesion = of.residual_cohesion;
    return model;
}

/// Weight and tilt applied at once.
Settling broughtOn(State& state, double tilt_deg, std::int64_t most_steps) {
    const Control control;
    QuasiStaticWork work = prepare(state, {.most_steps = most_steps}, control, 1e-4, false);
    return bringOn(state, work, [&](State& at, double share) { at.load.tilt = share * radians(tilt_deg); });
}

}  // namespace

TEST_SUITE("history") {
    TEST_CASE("stacks under a slowly applied tilt are stable or fail by limit equilibrium") {
        for (const Case& of : kCases) {
            CAPTURE(of.name);
            State state = *buildState(modelOf(of), false);
            const Settling settling = broughtOn(state, of.tilt_deg, 400'000);
            CHECK((settling.verdict == of.verdict));
            CHECK(settling.steps > 0);
            CHECK(!settling.reason.empty());
            if (of.verdict == Verdict::stable) CHECK(settling.out_of_balance < 1e-5);
            if (of.verdict == Verdict::stable) CHECK(kineticEnergy(state) == 0);
        }
    }

    TEST_CASE("a motion that takes more steps than it may is undecided, and says how far it came") {
        for (const Case& of : kCases) {
            CAPTURE(of.name);
            State state = *buildState(modelOf(of), false);
            const Settling settling = broughtOn(state, of.tilt_deg, 300);
            CHECK((settling.verdict == Verdict::undecided));
            CHECK(settling.reason.find("still moving") != std::string::npos);
        }
    }
}
