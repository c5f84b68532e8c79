#pragma once
// Slopes of rock that joint sets cut, as a scenario's text.

#include <doctest/doctest.h>

#include <optional>
#include <sstream>
#include <vector>

#include "talus/formats/scenario.h"

namespace talus::test {

struct CuttingSet {
    double dip_deg, dip_direction_deg, spacing;  ///< [deg, deg, m]
};

/// The face rises from (0, 0) to (crest, height); the ground goes on a third of the height before it, and a
/// fifth below.
struct RockSlope {
    double height, crest, back, width;         ///< [m]
    std::optional<double> plane_dip_deg{};     ///< of a plane through the toe, below which nothing moves
    double density = 2600;                     ///< [kg/m^3]
    double normal_stiffness, shear_stiffness;  ///< [Pa/m]
    double friction_deg, cohesion = 0;         ///< [deg, Pa]
    std::vector<CuttingSet> sets;
};

/// Columns on bases that dip gently out of the slope; they lean far before they fall.
inline RockSlope uprightColumns() {
    return {.height = 16.67,
            .crest = 9.51,
            .back = 28.32,
            .width = 14.38,
            .plane_dip_deg = 30.3,
            .density = 2347,
            .normal_stiffness = 2.21e9,
            .shear_stiffness = 1.53e9,
            .friction_deg = 31.43,
            .sets = {{90, 90, 3.2}, {90, 0, 4.58}, {7.8, 270, 7.9}}};
}

inline formats::Scenario scenarioOf(const RockSlope& s) {
    const double left = -0.3 * s.height, under = -0.2 * s.height;
    std::ostringstream text;
    text.precision(17);
    text << "[material.rock]\ndensity = " << s.density << "\n[joint.default]\n"
         << std::scientific << "normal_stiffness = " << s.normal_stiffness
         << "\nshear_stiffness = " << s.shear_stiffness << "\nfriction_deg = " << s.friction_deg
         << "\ncohesion = " << s.cohesion << "\n[rock_mass]\nregion = { profile = [[" << left << ", " << under
         << "], [" << s.back << ", " << under << "], [" << s.back << ", " << s.height << "], [" << s.crest
         << ", " << s.height << "], [0.0, 0.0], [" << left << ", 0.0]], y = [0.0, " << s.width
         << "] }\nmin_thickness = " << 0.006 * s.height
         << "\nfixed = [{ boundary = \"-z\" }, { boundary = \"+x\" }";
    if (s.plane_dip_deg) {
        text << ", { plane = { point = [0, 0, 0], dip_deg = " << *s.plane_dip_deg
             << ", dip_direction_deg = 270 } }";
    }
    text << "]\n";
    for (std::size_t k = 0; k < s.sets.size(); ++k) {
        text << "[[joint_set]]\nname = \"J" << k << "\"\ndip_deg = " << s.sets[k].dip_deg
             << "\ndip_direction_deg = " << s.sets[k].dip_direction_deg << "\nspacing = " << s.sets[k].spacing
             << "\n";
    }
    auto scenario = formats::parseScenario(text.str(), "slope.toml");
    for (const Error& error : scenario.errors()) FAIL_CHECK(formats::format(error));
    REQUIRE(scenario.ok());
    return std::move(*scenario);
}

}  // namespace talus::test
