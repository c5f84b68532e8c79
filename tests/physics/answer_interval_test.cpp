// The interval of an answer: how far it may depend on the loading path.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "support/models.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

namespace {

Model modelOf(const std::string& path) {
    auto scenario = formats::readScenario(TALUS_SOURCE_DIR "/bench/" + path);
    REQUIRE(scenario.ok());
    return scenario->model;
}

/// Columns of blocks 0.2 x 0.1 x 0.1 m, so many high each.
Model columnsOf(const std::vector<int>& heights, double friction_deg, double shear_over_normal) {
    Model model = floorModel(friction_deg, 3.375e11);
    model.joints[0].shear_stiffness = shear_over_normal * model.joints[0].normal_stiffness;
    for (std::size_t c = 0; c < heights.size(); ++c)
        for (int r = 0; r < heights[c]; ++r)
            addBox(model, "c" + std::to_string(c + 1) + "r" + std::to_string(r + 1),
                   {0.2 * static_cast<double>(c), 0, 0.1 * r}, {0.2, 0.1, 0.1});
    return model;
}

double lowerEnd(const SearchResult& result) {
    REQUIRE(result.answer_interval.has_value());
    CHECK(result.answer_interval->first <= result.answer);
    CHECK(result.answer_interval->second >= result.answer);
    return result.answer_interval->first;
}

/// Whether another loading path has a lower answer than the search's.
bool hasLower(const SearchResult& result) {
    const std::string& reason = result.answer_interval_reasons.first;
    if (reason.starts_with("pressure over the closed part") ||
        reason.starts_with("joints ten times as stiff"))
        return false;  // elastic joints, not another loading path
    return result.answer - lowerEnd(result) > result.high - result.low;
}

}  // namespace

TEST_SUITE("physics") {
    // Low columns wedge tall ones while they slide between them, and rougher ones do not slide. The loading
    // paths of tilt and factor of safety differ, but their lower ends must agree.
    TEST_CASE(
        "columns of unequal heights have a factor of one or more below the lower end of their interval") {
        std::mt19937 random(20);
        const auto between = [&](int least, int most) {
            return std::uniform_int_distribution(least, most)(random);
        };
        int with_lower = 0;
        for (int k = 0; k < 24; ++k) {
            std::vector<int> heights(static_cast<std::size_t>(between(2, 6)));
            for (int& height : heights) height = between(1, 7);
            const double friction = between(200, 440) / 10.0;
            Model model = columnsOf(heights, friction, between(0, 1) == 0 ? 1.0 : 0.1);
            CAPTURE(k);
            const auto tilted = criticalAngle(model);
            REQUIRE(tilted.ok());
            REQUIRE((tilted->status == SearchStatus::found));
            with_lower += hasLower(*tilted);
            model.gravity.tilt = lowerEnd(*tilted) - radians(0.4);
            const auto reduced = safetyFactor(model);
            REQUIRE(reduced.ok());
            REQUIRE((reduced->status == SearchStatus::found));
            CHECK(reduced->answer > 0.999);
        }
        MESSAGE(with_lower << " of 24 have a lower answer");
        CHECK(with_lower > 0);
        CHECK(with_lower < 24);
    }

    TEST_CASE(
        "a low column that wedges a tall one: rougher joints fail no earlier than the interval begins") {
        double least = std::numeric_limits<double>::infinity();
        for (const double friction : {40.0, 36.0, 32.0, 28.0, 24.0, 20.0}) {
            CAPTURE(friction);
            Model model = columnsOf({6, 2, 6}, friction, 1.0);
            for (Joint& joint : model.joints) {  // the pivots of elastic joints lie elsewhere
                joint.normal_stiffness *= 100;
                joint.shear_stiffness *= 100;
            }
            const auto result = criticalAngle(model);
            REQUIRE(result.ok());
            REQUIRE((result->status == SearchStatus::found));
            CHECK(lowerEnd(*result) < 1.01 * least);
            least = std::min(least, lowerEnd(*result));
        }
        CHECK(least == doctest::Approx(std::atan(0.2 / 0.6)).epsilon(0.01));  // of a tall column by itself
    }

    TEST_CASE("what statics alone decides has no lower answer: a sliding stack, a column, an arch") {
        for (const double friction : {15.0, 25.0}) {
            const auto slide = criticalAngle(stackModel(2, 1, 1, friction));
            REQUIRE(slide.ok());
            CHECK(std::abs(slide->answer * 180 / M_PI - friction) < 0.02);
            CHECK_FALSE(hasLower(*slide));
        }
        for (const std::string name : {"column-10", "column-20", "arch-27-1.2m", "bilinear-slab"}) {
            CAPTURE(name);
            const Model model = modelOf("verification/" + name + ".toml");
            const bool is_slab = name == "bilinear-slab";
            const auto result = is_slab ? safetyFactor(model) : criticalAngle(model);
            REQUIRE(result.ok());
            CHECK_FALSE(hasLower(*result));
        }
    }

    TEST_CASE("Goodman and Bray's columns fail at one factor, for any loading path") {
        for (const std::string name : {"goodman-bray", "goodman-bray-slice-38.15"})
            for (const double friction : {36.0, 38.15, 40.0}) {
                CAPTURE(name);
                CAPTURE(friction);
                Model model = modelOf("verification/" + name + ".toml");
                for (Joint& joint : model.joints)
                    joint.friction = joint.residual_friction = radians(friction);
                const auto result = safetyFactor(model);
                REQUIRE(result.ok());
                CHECK_FALSE(hasLower(*result));
            }
    }

    TEST_CASE("equal columns side by side fail where one of them does, or have that in their interval") {
        for (const int rows : {5, 7, 9}) {
            CAPTURE(rows);
            const auto result = criticalAngle(stackModel(3, rows, 1, 38, {0.2, 0.1, 0.1}, 1e12));
            REQUIRE(result.ok());
            const double low = lowerEnd(*result);
            MESSAGE("three columns of " << rows << ": " << degrees(low) << " to " << degrees(result->answer));
            const double alone = std::atan(0.2 / (0.1 * rows));  // of a single column on rigid joints
            CHECK(low > 0.95 * alone);
            CHECK(low < 1.001 * alone);
            CHECK((result->answer_interval_reasons.first.find("no friction on the ") == 0) ==
                  hasLower(*result));
        }
    }

    // Pressed by nanometres, side faces rougher than 45 degrees hold columns that lean on each other at tilts
    // at which each of them topples by itself: whatever holds them, the interval has to begin no later than
    // there.
    TEST_CASE("columns rougher than 45 degrees have an interval that begins where one column topples") {
        int above = 0;
        for (const int columns : {2, 3, 4, 6, 8})
            for (const double friction : {50.0, 55.0, 60.0}) {
                CAPTURE(columns);
                CAPTURE(friction);
                const double exact = std::atan(0.3 / (0.2 * 4));
                const auto result =
                    criticalAngle(stackModel(columns, 4, 1, friction, {0.3, 1.0, 0.2}, 3.4e11));
                REQUIRE(result.ok());
                REQUIRE((result->status == SearchStatus::found));
                const double low = lowerEnd(*result);
                CHECK(low < 1.005 * exact);
                CHECK(low > 0.85 * exact);
                above += result->answer > 1.01 * low;
            }
        MESSAGE(above << " of 15 answers lie above the lower end of their interval");
        CHECK(above > 0);
    }

    TEST_CASE("no lower answer is looked for where it is not wanted") {
        const auto never = criticalAngle(stackModel(3, 7, 1, 38, {0.2, 0.1, 0.1}, 1e10), {.interval = false});
        REQUIRE(never.ok());
        CHECK(lowerEnd(*never) == never->answer);
    }
}
