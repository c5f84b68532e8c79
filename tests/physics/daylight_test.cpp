// Water in a joint that daylights at its lower end: Hoek and Bray's distributions, by the factor of safety of
// the block above.

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "support/bench_scenario.h"
#include "support/models.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kDip = 35, kFriction = 60;  // [deg]

std::string frictional(double end) {
    std::string text = bench(kDip, end, 0, 0);
    const std::string weak = "friction_deg = 30.000000";
    return text.replace(text.find(weak), weak.size(), "friction_deg = 60.0");
}

double factorUnder(const std::string& water) {
    const auto scenario =
        formats::parseScenario(frictional(10) + "[[water]]\njoint = \"J\"\n" + water, "bench.toml");
    REQUIRE(scenario.ok());
    const auto result = safetyFactor(scenario->model);
    REQUIRE(result.ok());
    CHECK((result->status == SearchStatus::found));
    return result->answer;
}

/// \param uplift  mean pressure on the joint [Pa]
double factorByHand(double uplift) {
    const double dip = radians(kDip), area = 2 * 10 / std::cos(dip);
    const double weight = 2600 * 9.81 * 2 * 10 * (9 - 5 * std::tan(dip));
    return (weight * std::cos(dip) - uplift * area) * std::tan(radians(kFriction)) / (weight * std::sin(dip));
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("daylighting joints: straight to nothing, or rising to the middle and falling from there") {
        const double height = 10 * std::tan(radians(kDip)), top = 1 + height;  // of the joint [m]
        const auto elevation = [](double z) { return "elevation = " + std::to_string(z) + "\n"; };
        for (const double above : {1.0, 4.0}) {  // of the joint's upper end, in a crack there
            CAPTURE(above);
            CHECK(factorUnder(elevation(top + above) + "daylights = \"straight\"\n") ==
                  doctest::Approx(factorByHand(0.5 * 9810 * above)).epsilon(0.003));
        }
        CHECK(factorUnder(elevation(top) + "daylights = \"half-height\"\n") ==
              doctest::Approx(factorByHand(0.25 * 9810 * height)).epsilon(0.003));
        CHECK(factorUnder(elevation(top)) ==
              doctest::Approx(factorByHand(0.5 * 9810 * height)).epsilon(0.003));
    }
}
