// Blocks that lie a little above what they are to lie on: they settle there, and then fail where they would
// without the gap.

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "support/models.h"
#include "talus/analysis.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kFriction = 30;  // [deg]

/// Bricks one on the other, each bed that far off.
Model bricks(int count, double gap) {
    Model model = floorModel(kFriction, 1e10);
    for (int k = 0; k < count; ++k)
        addBox(model, "b" + std::to_string(k), {0, 0, 0.2 * k + gap * (k + 1)}, {0.5, 0.5, 0.2}, 2000);
    return model;
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("bricks on beds that gape slide at their friction angle once they lie") {
        for (const int count : {1, 2, 3})
            for (const double gap : {1e-5, 5e-5, 2e-4, 1e-3}) {
                CAPTURE(count);
                CAPTURE(gap);
                const SearchResult angle = *criticalAngle(bricks(count, gap), {.interval = false});
                REQUIRE((angle.status == SearchStatus::found));
                CHECK(degrees(angle.answer) == doctest::Approx(kFriction).epsilon(1e-3));
                CHECK((angle.mode == FailureMode::sliding));
                CHECK(angle.fallen_at_start.empty());

                Model model = bricks(count, gap);
                model.gravity.tilt = radians(20);
                const SearchResult factor = *safetyFactor(model, {.interval = false});
                REQUIRE((factor.status == SearchStatus::found));
                CHECK(factor.answer ==
                      doctest::Approx(std::tan(radians(kFriction)) / std::tan(radians(20))).epsilon(2e-3));

                model.gravity.tilt = radians(10);
                const SearchResult push = *criticalAcceleration(model, {.interval = false});
                REQUIRE((push.status == SearchStatus::found));
                CHECK(push.answer == doctest::Approx(std::tan(radians(kFriction - 10))).epsilon(2e-3));
            }
    }

    TEST_CASE("bricks steeper than their friction angle are unstable on open beds, too") {
        for (const double gap : {2e-4, 1e-3}) {
            CAPTURE(gap);
            Model model = bricks(2, gap);
            model.gravity.tilt = radians(kFriction + 1);
            const SearchResult factor = *safetyFactor(model, {.interval = false});
            REQUIRE((factor.status == SearchStatus::found));
            CHECK(factor.answer ==
                  doctest::Approx(std::tan(radians(kFriction)) / std::tan(radians(kFriction + 1)))
                      .epsilon(2e-3));
        }
    }
}
