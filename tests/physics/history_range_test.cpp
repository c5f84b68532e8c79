// Whether an answer depends on how its load was reached.

#include <doctest/doctest.h>

#include <algorithm>
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

    TEST_CASE("Goodman and Bray's columns fail at one factor, whatever the history") {
        for (const std::string name : {"goodman-bray", "goodman-bray-slice-38.15"})
            for (const double friction : {36.0, 38.15, 40.0}) {
                CAPTURE(name);
                CAPTURE(friction);
                Model model = modelOf("verification/" + name + ".toml");
                for (Joint& joint : model.joints)
                    joint.friction = joint.residual_friction = radians(friction);
                const auto result = safetyFactor(model, kAnySize);
                REQUIRE(result.ok());
                CHECK_FALSE(result->range.has_value());
                CHECK(result->range_reason.find("same place") != std::string::npos);
            }
    }

    TEST_CASE("columns wedged between each other have a range, with the answer at one end") {
        for (const int rows : {5, 7, 9}) {
            CAPTURE(rows);
            const auto result = criticalAngle(stackModel(3, rows, 1, 38, {0.2, 0.1, 0.1}, 1e10), kAnySize);
            REQUIRE(result.ok());
            REQUIRE(result->range.has_value());
            const auto [low, high] = *result->range;
            MESSAGE("three columns of " << rows << ": " << low * 180 / M_PI << " to " << high * 180 / M_PI);
            CHECK(low < high);
            CHECK((result->answer == low || result->answer == high));
            CHECK(low > 0.95 * std::atan(0.2 / (0.1 * rows)));  // of a single column on rigid joints
            CHECK(result->range_reason.find("friction remembers") != std::string::npos);
            const bool warned =
                std::any_of(result->warnings.begin(), result->warnings.end(), [](const std::string& w) {
                    return w.starts_with("the answer is above the lower end of its range");
                });
            CHECK(warned == (result->answer == high && high - low > 0.01 * high));
        }
    }

    // Pressed by nanometres, side faces rougher than 45 degrees hold columns that lean on each other at tilts at which each of them
    // topples by itself: whatever holds them, the range has to begin no later than there.
    TEST_CASE("columns rougher than 45 degrees have a range that begins where one column topples") {
        int above = 0;
        for (const int columns : {2, 3, 4, 6, 8})
            for (const double friction : {50.0, 55.0, 60.0}) {
                CAPTURE(columns);
                CAPTURE(friction);
                const double exact = std::atan(0.3 / (0.2 * 4));
                const auto result =
                    criticalAngle(stackModel(columns, 4, 1, friction, {0.3, 1.0, 0.2}, 3.4e11), kAnySize);
                REQUIRE(result.ok());
                REQUIRE((result->status == SearchStatus::found));
                const double low = result->range ? result->range->first : result->answer;
                CHECK(low < 1.005 * exact);
                CHECK(low > 0.85 * exact);
                if (result->answer < 1.01 * low) continue;
                ++above;
                CHECK(std::any_of(result->warnings.begin(), result->warnings.end(),
                                  [](const std::string& warning) {
                                      return warning.starts_with("the answer is above the lower end");
                                  }));
            }
        MESSAGE(above << " of 15 answers lie above their range's lower end");
        CHECK(above > 0);
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
