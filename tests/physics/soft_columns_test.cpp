// Columns that dip into a slope, on joints as soft as jointed rock's often are: they lean by hundredths of their width before they fail,
// and come to stand on ledges that were none. However they are drawn, the answer is found, and not above limit analysis.

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "answers/stiffer_joints.h"
#include "support/models.h"
#include "support/rock_slopes.h"

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

/// \return what was made of the joints for the answer
double checkFound(const RockSlope& slope) {
    const auto answer =
        tools::findUnderCeiling(*loadSearch("safety-factor"), scenarioOf(slope), {.always = true}, {});
    REQUIRE(answer.ok());
    const SearchResult& found = answer->result;
    CHECK((found.status == SearchStatus::found));
    CHECK(found.confirmed);
    REQUIRE(answer->ceiling.value);
    CHECK_FALSE(isAbove(found.low, answer->ceiling, Varied::factor));
    MESSAGE(found.blocks << " blocks: " << found.answer << ", ceiling " << *answer->ceiling.value
                         << ", stiffness times " << answer->stiffness);
    return answer->stiffness;
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("columns on soft joints that change the slope's shape are answered for the shape as built") {
        const RockSlope leaning{.height = 17.55,
                                .crest = 5.82,
                                .back = 32.53,
                                .width = 15.72,
                                .density = 2481,
                                .normal_stiffness = 7.85e9,
                                .shear_stiffness = 3.47e8,
                                .friction_deg = 37.49,
                                .sets = {{61.6, 90, 1.82}, {9.9, 270, 6.31}}};
        CHECK(checkFound(leaning) > 1);
        RockSlope stiff = leaning;
        stiff.normal_stiffness *= 100;
        stiff.shear_stiffness *= 100;
        CHECK(checkFound(stiff) == 1);
    }
}

TEST_SUITE("slow: physics") {
    TEST_CASE("columns on soft joints at random are found, and not above limit analysis") {
        constexpr unsigned kSlopes = 8;
        int changed = 0;
        for (unsigned seed = 1; seed <= kSlopes; ++seed) {
            CAPTURE(seed);
            changed += checkFound(drawn(seed)) > 1;
        }
        CHECK(changed >= 1);  // else these are no slopes of that kind
        CHECK(changed < static_cast<int>(kSlopes));
    }
}
