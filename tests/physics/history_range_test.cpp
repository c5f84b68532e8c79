// Whether an answer depends on how its load was reached.

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "support/models.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

namespace {

const Control kAnySize{.most_points_of_range = std::numeric_limits<std::size_t>::max()};

Model modelOf(const std::string& path) {
    auto scenario = formats::readScenario(TALUS_SOURCE_DIR "/bench/" + path);
    REQUIRE(scenario.ok());
    return scenario->model;
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("what statics alone decides has no range: a sliding stack, a column, an arch") {
        for (const double friction : {15.0, 25.0}) {
            const auto slide = criticalAngle(stackModel(2, 1, 1, friction), kAnySize);
            REQUIRE(slide.ok());
            CHECK(std::abs(slide->answer * 180 / M_PI - friction) < 0.02);
            CHECK_FALSE(slide->range.has_value());
            CHECK(slide->range_reason.find("same place") != std::string::npos);
        }
        for (const std::string name : {"column-10", "column-20", "arch-27-1.2m", "bilinear-slab"}) {
            CAPTURE(name);
            const Model model = modelOf("verification/" + name + ".toml");
            const bool is_slab = name == "bilinear-slab";
            const auto result = is_slab ? safetyFactor(model, kAnySize) : criticalAngle(model, kAnySize);
            REQUIRE(result.ok());
            CHECK_FALSE(result->range.has_value());
            CHECK(result->range_reason.find("same place") != std::string::npos);
        }
    }

    TEST_CASE("columns that lean on each other by friction have one: Goodman and Bray's 1.000 lies in it") {
        const auto result = safetyFactor(modelOf("verification/goodman-bray.toml"), kAnySize);
        REQUIRE(result.ok());
        REQUIRE(result->range.has_value());
        const auto [low, high] = *result->range;
        MESSAGE("Goodman and Bray: " << low << " to " << high);
        CHECK(low < high);
        CHECK(low <= result->answer);
        CHECK(result->answer <= high);
        CHECK(low < 1.0);
        CHECK(high > 1.0);
        CHECK(result->range_reason.find("friction remembers") != std::string::npos);
    }

    TEST_CASE(
        "no range is looked for where it is not wanted, and the reason is said where the model is large") {
        const Model model = stackModel(2, 1, 1, 20);
        const auto never = criticalAngle(model);
        CHECK(never->range_reason.empty());
        const auto large = criticalAngle(model, {.most_points_of_range = 5});
        CHECK_FALSE(large->range.has_value());
        CHECK(large->range_reason.find("contact points; up to 5") != std::string::npos);
    }
}
