#pragma once
// The paper's own measurements and results: its figures occur only here. Source: Experimental investigation
// and numerical simulation on the effect of fissure water pressure in vertical sliding surface, Table 1
// (laboratory) and section 5 (DEM).

#include <array>

namespace talus::tools {

/// One column of the paper's Table 1.
struct LaboratorySeries {
    int fissure = 0;  ///< watered fissure, numbered from the toe; 0: no water
    std::array<double, 3> repeats_deg{};
    double average_deg = 0;  ///< as printed there, rounded to 0.1
};

inline constexpr std::array<LaboratorySeries, 7> kLaboratory{{
    {0, {18.9, 18.3, 18.1}, 18.4},
    {1, {4.5, 4.6, 4.3}, 4.5},
    {2, {13.5, 13.4, 13.0}, 13.3},
    {3, {15.3, 15.6, 15.3}, 15.4},
    {4, {16.1, 16.4, 16.4}, 16.3},
    {5, {16.6, 16.6, 16.9}, 16.7},
    {6, {17.5, 17.5, 17.2}, 17.4},
}};

inline constexpr double kLaboratoryWaterDepth = 0.35;  ///< at limit equilibrium, all watered tests [m]

/// Friction angles: the ends of the range measured in the laboratory, and Table 2's value between them.
inline constexpr std::array<double, 3> kPaperFrictionDeg{18.0, 19.5, 21.0};
inline constexpr double kTableFrictionDeg = 19.5;

inline constexpr double kPaperDemFissure7Deg = 17.8;       ///< section 5, water in fissure 7 only
inline constexpr double kPaperDemFissures7To10Deg = 17.0;  ///< section 5, water in fissures 7, 8, 9 and 10

}  // namespace talus::tools
