// Columns that dip into a slope, on joints as soft as jointed rock's often are. They lean by hundredths of
// their width before they fail, and then stand on ledges that were none. However they are drawn, an answer is
// found. If it is exceeds the upper bound of limit analysis, which is for the shape as built, a warning says
// so.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/models.h"
#include "support/rock_slopes.h"
#include "talus/limit_analysis.h"
#include "talus/searches.h"

using namespace talus;
using namespace talus::test;

namespace {

RockSlope drawn(unsigned seed) {
    std::mt19937_64 random(seed);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() >> 11) / 9007199254740992.0;
    };
    RockSlope slope;
    slope.height = between(6, 30);
    const double spacing = slope.height / between(3, 7);
    slope.crest = slope.height / std::tan(radians(between(50, 85)));
    slope.back = slope.crest + 1.2 * slope.height;
    slope.width = 0.8 * slope.height;
    slope.friction_deg = between(22, 45);
    slope.normal_stiffness = std::pow(10, between(9, 10.3));
    slope.shear_stiffness = std::pow(10, between(8.5, 9.7));
    const CuttingSet columns{between(55, 70), 90, spacing * between(0.3, 0.5)};
    slope.sets = {columns, {between(5, 30), 270, spacing * between(1, 2)}};
    return slope;
}

/// \param is_stiff  so stiff that nothing leans before it fails
void checkFound(const RockSlope& slope, bool is_stiff = false) {
    const auto answer =
        safetyFactor(scenarioOf(slope).model, {.interval = false, .upper_bound = Beside::always});
    REQUIRE(answer.ok());
    CHECK((answer->status == SearchStatus::found));
    CHECK(!answer->moving_blocks.empty());
    REQUIRE(answer->upper_bound.value);
    MESSAGE(answer->blocks << " blocks: " << answer->low << " to " << answer->high << ", upper bound "
                           << *answer->upper_bound.value);
    const auto& warnings = answer->warnings;
    const bool is_said = std::any_of(warnings.begin(), warnings.end(), [](const std::string& text) {
        return text.find("exceeds the upper bound of limit analysis") != std::string::npos;
    });
    CHECK(is_said == isAbove(answer->low, answer->upper_bound, Varied::factor));
    REQUIRE(answer->answer_interval.has_value());
    CHECK(answer->answer_interval->first <= 1.005 * *answer->upper_bound.value);
    if (is_stiff) CHECK_FALSE(is_said);
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("columns on soft joints that change the slope's shape say so") {
        const RockSlope leaning{.height = 17.55,
                                .crest = 5.82,
                                .back = 32.53,
                                .width = 15.72,
                                .density = 2481,
                                .normal_stiffness = 7.85e9,
                                .shear_stiffness = 3.47e8,
                                .friction_deg = 37.49,
                                .sets = {{61.6, 90, 1.82}, {9.9, 270, 6.31}}};
        checkFound(leaning);
        RockSlope stiff = leaning;
        stiff.normal_stiffness *= 100;
        stiff.shear_stiffness *= 100;
        checkFound(stiff, true);
    }
}

TEST_SUITE("slow: physics") {
    TEST_CASE("columns on soft joints at random are found") {
        constexpr unsigned kSlopes = 8;
        for (unsigned seed = 1; seed <= kSlopes; ++seed) {
            CAPTURE(seed);
            checkFound(drawn(seed));
        }
    }
}
