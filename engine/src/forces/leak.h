#pragma once
// What flows out of a fissure through the joint below its foot, and the volume that is left: pure functions.
//
// Laminar flow between parallel walls a hydraulic aperture b apart follows the cubic law (P. A. Witherspoon,
// J. S. Y. Wang, K. Iwai and J. E. Gale, Water Resources Research 16, 1016, 1980), per metre of width
//
//   q = rho g b^3 / (12 mu) * h / L
//
// The head h is the height of the water above the foot. The water leaves the rock at the height of the foot,
// a path length L away and without pressure. A volume V that gains Q and leaks k V per second follows
// dV/dt = Q - k V with k = w q / V, so that after a time t
//
//   V(t) = V e^(-k t) + Q (1 - e^(-k t)) / k.
//
// In a prism k does not depend on the level, and any step is exact for a steady Q. Elsewhere k is that of the
// beginning of the step. No step is unstable, and none leaves less than nothing.

#include <cmath>

namespace talus {

// [Pa s] Of water at 20 degrees. At 5 degrees it is 1.5e-3, and a leak is a third less.
inline constexpr double kWaterViscosity = 1.0e-3;

/// A leak through a joint.
struct Leak {
    double aperture = 0;     ///< b, hydraulic [m]
    double length = 1;       ///< L [m]
    double unit_weight = 0;  ///< rho g [N/m^3]

    /// Discharge per metre of width under a head [m^2/s].
    double under(double head) const {
        return unit_weight * aperture * aperture * aperture / (12 * kWaterViscosity) * head / length;
    }
};

/// V(t). \pre rate >= 0, time >= 0
/// \param gain  Q t [m^3]
/// \param rate  k [1/s]
inline double volumeLeft(double volume, double gain, double rate, double time) {
    const double x = rate * time;
    const double share = x > 0 ? -std::expm1(-x) / x : 1.0;
    return volume * std::exp(-x) + gain * share;
}

}  // namespace talus
