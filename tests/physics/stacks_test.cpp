// Stacks of blocks against limit equilibrium: near the tilt at which their columns overturn, with and without
// water.

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "support/models.h"
#include "talus/analysis.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kWater = 1000, kRock = 2700, kGravity = 9.81;

struct Stack {
    int columns, rows;
    double width, height, depth;  // of a block [m]
    double friction;              // [deg]
    double water = 0;             // in the fissure behind the first column, not above the first row [m]

    Model model() const {
        Model made = stackModel(columns, rows, 1, friction, {width, depth, height}, 1.35e11);
        if (water > 0) made.waters = {fissureAt(made, width, water)};
        return made;
    }
    /// Weight of the first column, and the thrust on it at a tilt.
    double weight() const { return kRock * kGravity * width * depth * height * rows; }
    double thrust(double tilt) const {
        return 0.5 * kWater * kGravity * std::cos(tilt) * water * water * depth;
    }
    /// At which the first column overturns: nothing leans on it but the water.
    double overturns() const {
        const double h = height * rows;
        return std::atan(width / h -
                         2 * 0.5 * kWater * kGravity * water * water * depth * water / (3 * weight() * h));
    }
    /// At which the first column slides on its base, pushed by the water.
    double slides() const {
        const double thrust_over_weight = thrust(0) / weight();
        return std::atan(std::tan(radians(friction)) - thrust_over_weight);
    }
    double factor(double tilt) const {
        return weight() * std::cos(tilt) * std::tan(radians(friction)) /
               (weight() * std::sin(tilt) + thrust(tilt));
    }
};

const std::vector<Stack>& stacks() {
    static const std::vector<Stack> all{
        {2, 5, 0.181, 0.134, 0.172, 32.36, 0.0718}, {2, 5, 0.181, 0.134, 0.172, 32.36},
        {1, 5, 0.181, 0.134, 0.172, 32.36, 0.0718}, {3, 5, 0.181, 0.134, 0.172, 28.0, 0.1},
        {2, 4, 0.19, 0.18, 0.25, 35.0, 0.12},       {3, 6, 0.25, 0.155, 0.2, 25.0},
        {4, 3, 0.1, 0.125, 0.1, 40.0, 0.05}};
    return all;
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE(
        "stacks near the tilt at which their columns overturn: the factor of sliding, falling with the "
        "tilt") {
        for (const Stack& stack : stacks()) {
            CAPTURE(stack.columns);
            CAPTURE(stack.rows);
            CAPTURE(stack.friction);
            CAPTURE(stack.water);
            double before = kInfinity;
            for (const double below_deg : {2.0, 1.0, 0.7, 0.5, 0.3, 0.15}) {
                Model model = stack.model();
                model.gravity.tilt = stack.overturns() - radians(below_deg);
                CAPTURE(degrees(model.gravity.tilt));
                const SearchResult result = *safetyFactor(model, {.interval = false});
                REQUIRE((result.status == SearchStatus::found));
                CHECK(result.answer == doctest::Approx(stack.factor(model.gravity.tilt)).epsilon(0.003));
                CHECK((result.mode == FailureMode::sliding));
                CHECK(result.answer < before);
                before = result.answer;
            }
        }
    }

    TEST_CASE(
        "stacks beyond the tilt at which their columns overturn do not stand, whatever their strength") {
        for (const Stack& stack : stacks()) {
            CAPTURE(stack.columns);
            CAPTURE(stack.rows);
            CAPTURE(stack.friction);
            for (const double beyond_deg : {0.1, 0.5, 2.0}) {
                Model model = stack.model();
                model.gravity.tilt = stack.overturns() + radians(beyond_deg);
                CAPTURE(degrees(model.gravity.tilt));
                const SearchResult result = *safetyFactor(model, {.interval = false});
                const bool stands = result.status == SearchStatus::found && result.answer >= 1;
                CHECK_FALSE(stands);
                CHECK((result.status != SearchStatus::stable_to_stop));
            }
        }
    }

    TEST_CASE(
        "stacks fail at the tilt at which their first column slides or overturns, whichever comes first") {
        for (const Stack& stack : stacks()) {
            CAPTURE(stack.columns);
            CAPTURE(stack.rows);
            CAPTURE(stack.friction);
            CAPTURE(stack.water);
            const SearchResult result = *criticalAngle(stack.model(), {.interval = false});
            REQUIRE((result.status == SearchStatus::found));
            const double exact = std::min(stack.slides(), stack.overturns());
            CHECK(degrees(result.answer) == doctest::Approx(degrees(exact)).epsilon(0.003));
        }
    }
}
