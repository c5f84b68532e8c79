#include "checks/plausible.h"

#include <doctest/doctest.h>

#include "build/build.h"
#include "support/models.h"
#include "talus/limit_analysis.h"
#include "talus/searches.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kStiffness = 1e10;  // [Pa/m]

/// A box of 0.2 m on the floor: a force F presses it into its joint by F / (1e10 Pa/m * 0.04 m^2).
Model loaded(const AppliedLoad& load) {
    Model model = floorModel(30, kStiffness);
    addBox(model, "box", {0, 0, 0}, {0.2, 0.2, 0.2});
    model.loads = {load};
    model.loads[0].field = "load[0]";
    model.loads[0].block = 1;
    return model;
}

AppliedLoad force(double newton) { return {.force = Vec3(0, 0, -newton)}; }
AppliedLoad pressure(double pascal) {
    return {.kind = AppliedLoad::Kind::face, .direction = Vec3::UnitZ(), .pressure = pascal};
}

bool isTooStrong(const AppliedLoad& load) {
    const Model model = loaded(load);
    return !checks::strongLoads(*buildState(model, false)).empty();
}

}  // namespace

TEST_SUITE("checks") {
    TEST_CASE("loads that press a block into its joint by more than a tenth of its size are reported") {
        const double most_force = 0.1 * 0.2 * kStiffness * 0.04, most_pressure = 0.1 * 0.2 * kStiffness;
        CHECK_FALSE(isTooStrong(force(0.9 * most_force)));
        CHECK(isTooStrong(force(1.1 * most_force)));
        CHECK_FALSE(isTooStrong(pressure(0.9 * most_pressure)));
        CHECK(isTooStrong(pressure(1.1 * most_pressure)));
        AppliedLoad grows = force(0.5 * most_force);
        grows.factor = {{0.0, 0.0}, {1.0, 3.0}};
        CHECK(isTooStrong(grows));
    }

    TEST_CASE("searches and limit analysis refuse them, however large they are, and say where") {
        for (const double newton : {1e8, 1e20, 1e100, 1e200, 1e300}) {
            CAPTURE(newton);
            const Model model = loaded(force(newton));
            for (const auto& errors : {criticalAngle(model).errors(), safetyFactor(model).errors(),
                                       limitAnalysis(model, Varied::tilt).errors()}) {
                REQUIRE(errors.size() == 1);
                CHECK(errors[0].field == "load[0].force");
                CHECK(errors[0].message.find("presses block \"box\"") != std::string::npos);
            }
        }
    }
}
