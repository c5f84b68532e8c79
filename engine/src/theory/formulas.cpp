// The closed formulas that take numbers, not models.

#include <cmath>

#include "talus/theory.h"
#include "theory/limit_equilibrium.h"

namespace talus::theory {

namespace {

/// Thrust of water of depth H on a joint normal to the base, per width and per cos(tilt): rho_w g H^2 / 2
/// [N/m]. (Eq 16: the table is horizontal, so pressure grows along the tilted joint by rho_w g cos(tilt)
/// only.)
double thrustPerWidth(const SlidingMass& mass) {
    return 0.5 * mass.water_density * mass.gravity * mass.water_depth * mass.water_depth;
}

/// Weight per width (eqs 11 and 12 without their sine and cosine) [N/m].
double weightPerWidth(const SlidingMass& mass) {
    return mass.density * mass.gravity * mass.length * mass.height;
}

Mass perWidth(const SlidingMass& mass) {
    Mass result;
    result.weight = weightPerWidth(mass);
    result.friction_force = result.weight * std::tan(mass.friction);
    result.cohesion_force = mass.cohesion * mass.length;
    result.thrust = thrustPerWidth(mass);
    return result;
}

}  // namespace

double criticalTiltSliding(const SlidingMass& mass) { return slidingTilt(perWidth(mass)); }

double factorOfSafetySliding(const SlidingMass& mass, double tilt) {
    const Mass sums = perWidth(mass);
    const double resisting = sums.friction_force * std::cos(tilt) + sums.cohesion_force;
    const double driving = sums.weight * std::sin(tilt) + sums.thrust * std::cos(tilt);
    return driving > 0 ? resisting / driving : kInfinity;
}

double criticalTiltToppling(double length, double height, double density, double water_depth,
                            double water_density) {
    const double water = water_density * water_depth * water_depth * water_depth;
    return std::atan(length / height - water / (3 * density * length * height * height));
}

TensionCrackResult planeFailure(const TensionCrack& slope) {
    TensionCrackResult result;
    const double sine = std::sin(slope.plane), cosine = std::cos(slope.plane);
    const double run_to_crack = slope.slope_height / std::tan(slope.face) + slope.crest_distance;
    const double base_height = run_to_crack * std::tan(slope.plane);  // of the plane, below the crack
    result.crack_depth = slope.slope_height - base_height;
    result.base_area = base_height / sine;
    // The mass is the trapezium between toe, crest and crack, less the triangle under the plane.
    const double section =
        slope.slope_height * (run_to_crack - 0.5 * slope.slope_height / std::tan(slope.face)) -
        0.5 * run_to_crack * base_height;
    result.weight = slope.unit_weight * section;
    result.uplift = 0.5 * slope.water_unit_weight * slope.crack_water_depth * result.base_area;
    result.thrust = 0.5 * slope.water_unit_weight * slope.crack_water_depth * slope.crack_water_depth;
    const double normal = result.weight * cosine - result.uplift - result.thrust * sine;
    const double resisting = slope.cohesion * result.base_area + normal * std::tan(slope.friction);
    result.factor_of_safety = resisting / (result.weight * sine + result.thrust * cosine);
    return result;
}

}  // namespace talus::theory
