// Columns that dip into a slope, on joints as soft as jointed rock's often are: they lean by hundredths of their width before they fail,
// and come to stand on ledges that were none. However they are drawn, the answer is found, and not above limit analysis.

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <sstream>
#include <string>

#include "answers/stiffer_joints.h"
#include "support/models.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

namespace {

struct Shape {
    double height, face_deg, friction_deg, normal_stiffness, shear_stiffness;  // [m, deg, deg, Pa/m, Pa/m]
    double column_dip_deg, column_spacing, base_dip_deg, base_spacing;         // [deg, m, deg, m]
};

Shape drawn(unsigned seed) {
    std::mt19937_64 random(seed);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() >> 11) / 9007199254740992.0;
    };
    const double height = between(6, 30), spacing = height / between(3, 7);
    return {height,
            between(50, 85),
            between(22, 45),
            std::pow(10, between(9, 10.3)),
            std::pow(10, between(8.5, 9.7)),
            between(55, 70),
            spacing * between(0.3, 0.5),
            between(5, 30),
            spacing * between(1, 2)};
}

formats::Scenario slopeOf(const Shape& s) {
    const double crest = s.height / std::tan(radians(s.face_deg)), back = crest + 1.2 * s.height;
    const double left = -0.3 * s.height, under = -0.2 * s.height;
    std::ostringstream text;
    text << "[material.rock]\ndensity = 2600\n[joint.default]\nnormal_stiffness = " << std::scientific
         << s.normal_stiffness << "\nshear_stiffness = " << s.shear_stiffness
         << "\nfriction_deg = " << s.friction_deg << "\n[rock_mass]\nregion = { profile = [[" << left << ", "
         << under << "], [" << back << ", " << under << "], [" << back << ", " << s.height << "], [" << crest
         << ", " << s.height << "], [0, 0], [" << left << ", 0]], y = [0, " << 0.8 * s.height
         << "] }\nmin_thickness = " << 0.006 * s.height
         << "\nfixed = [{ boundary = \"-z\" }, { boundary = \"+x\" }]\n"
            "[[joint_set]]\nname = \"columns\"\ndip_deg = "
         << s.column_dip_deg << "\ndip_direction_deg = 90\nspacing = " << s.column_spacing
         << "\n[[joint_set]]\nname = \"bases\"\ndip_deg = " << s.base_dip_deg
         << "\ndip_direction_deg = 270\nspacing = " << s.base_spacing << "\n";
    const auto scenario = formats::parseScenario(text.str(), "columns.toml");
    REQUIRE(scenario.ok());
    return *scenario;
}

/// \return what was made of the joints for the answer
double checkFound(const Shape& shape) {
    const auto answer =
        tools::findUnderCeiling(*loadSearch("safety-factor"), slopeOf(shape), {.always = true}, {});
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
        const Shape leaning{17.55, 71.7, 37.49, 7.85e9, 3.47e8, 61.6, 1.82, 9.9, 6.31};
        CHECK(checkFound(leaning) > 1);
        Shape stiff = leaning;
        stiff.normal_stiffness *= 1e3;
        stiff.shear_stiffness *= 1e3;
        CHECK(checkFound(stiff) == 1);
    }
}

TEST_SUITE("slow: physics") {
    TEST_CASE("columns on soft joints at random are found, and not above limit analysis") {
        constexpr unsigned kSlopes = 12;
        int changed = 0;
        for (unsigned seed = 1; seed <= kSlopes; ++seed) {
            CAPTURE(seed);
            changed += checkFound(drawn(seed)) > 1;
        }
        CHECK(changed >= 2);  // else these are no slopes of that kind
        CHECK(changed < static_cast<int>(kSlopes));
    }
}
