#pragma once
// Closed formulas: the paper's section 4 (eqs 10-17, corrected) and block limit equilibrium. Angles in rad.

#include <optional>
#include <string>
#include <vector>

#include "talus/model.h"

namespace talus::theory {

/// A mass of length x and height h on a plane at phi, water of depth H behind it, cohesion C on the base: the
/// tilt at which sliding is in limit equilibrium. With C = 0: tan(beta) = tan(phi) - rho_w H^2 / (2 rho x h),
/// the paper's eq 17 without its stray g.
struct SlidingMass {
    double length = 0, height = 0;             ///< x, h [m]
    double density = 0, water_density = 1000;  ///< [kg/m^3]
    double water_depth = 0;                    ///< H [m]
    double friction = 0;                       ///< phi [rad]
    double cohesion = 0;                       ///< C [Pa]
    double gravity = 9.81;                     ///< [m/s^2]; matters with cohesion only
};
double criticalTiltSliding(const SlidingMass& mass);

/// Factor of safety against sliding at tilt beta (eqs 13-16): resisting over driving force.
double factorOfSafetySliding(const SlidingMass& mass, double tilt);

/// Overturning of a single body about its toe: tan(beta) = x/h - rho_w H^3 / (3 rho x h^2).
double criticalTiltToppling(double length, double height, double density, double water_depth,
                            double water_density = 1000);

/// The formulas' prediction for a model to which they apply.
struct Prediction {
    double critical_tilt = 0;           ///< [rad]
    bool topples = false;               ///< else slides
    std::string formula;                ///< which, with its numbers, in words
    std::string applies_because;        ///< the assumptions met
    std::vector<std::string> blocks{};  ///< that move, sorted

    /// The formula's name.
    const char* kind() const { return topples ? "overturning about the toe" : "sliding on a plane"; }
};

/// The lowest limit-equilibrium tilt of a model to which the formulas apply, else nothing. They apply to one
/// stack in "stack" bond with uniform density: columns in front of each watered fissure or of each joint
/// slide on a bed level, or the toe column overturns. They also apply to one free box on a fixed plane.
/// Nothing is returned rather than a guess.
std::optional<Prediction> predict(const Model& model);

/// Hoek and Bray's plane failure with a water-filled tension crack; lengths in m, unit weights in N/m^3.
struct TensionCrack {
    double slope_height = 12, face = 0, plane = 0, crest_distance = 4;  ///< angles [rad]
    double cohesion = 0, friction = 0, unit_weight = 26000, water_unit_weight = 9810;
    double crack_water_depth = 0;
};
struct TensionCrackResult {
    double factor_of_safety = 0, crack_depth = 0, base_area = 0, weight = 0, uplift = 0, thrust = 0;
};
TensionCrackResult planeFailure(const TensionCrack& slope);

}  // namespace talus::theory
