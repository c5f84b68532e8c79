// A plane that daylights at the toe of a slope with ground in front of it. The tip of the slide runs onto the
// ground and is lifted there, or sinks into its joint beside it: neither may hold the slide, whose answer is
// that of limit equilibrium.

#include <doctest/doctest.h>

#include "support/models.h"
#include "support/plane_slope.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

namespace {

void checkSlides(const PlaneSlope& slope) {
    CAPTURE(slope.scenario());
    const auto scenario = formats::parseScenario(slope.scenario(), "plane.toml");
    REQUIRE(scenario.ok());
    const auto result = safetyFactor(scenario->model);
    REQUIRE(result.ok());
    REQUIRE((result->status == SearchStatus::found));
    const double by_hand = slope.factor(0, [](double) { return 0.0; });
    CHECK(result->answer == doctest::Approx(by_hand).epsilon(0.003));
    CHECK((result->mode == FailureMode::sliding));
    REQUIRE(result->answer_interval.has_value());
    CHECK(result->answer_interval->second <= by_hand * 1.003);
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("a slide whose tip runs onto the ground in front of it has the answer of the slide") {
        for (const double ground : {0.0, 20.0})
            for (const double cohesion : {0.0, 25e3})
                for (const double dip : {25.0, 35.0, 45.0}) {
                    PlaneSlope slope{.plane_deg = dip, .cohesion = cohesion, .ground = ground};
                    slope.crack_at = slope.crest() + 8;
                    checkSlides(slope);
                }
    }
}
