#pragma once
// Laminar flow in a joint, and how much a joint conducts that is not full.

#include <algorithm>

namespace talus::flow {

/// Discharge per width of joint and per unit gradient of the head: T = rho g b^3 / (12 mu) [m^2/s], the cubic
/// law of parallel walls (Witherspoon, Wang, Iwai and Gale 1980, Water Resources Research 16(6)).
/// \param unit_weight  rho g [N/m^3]
/// \param aperture     hydraulic, b [m]
/// \param viscosity    dynamic, mu [Pa s]
inline double transmissivity(double unit_weight, double aperture, double viscosity) {
    return unit_weight * aperture * aperture * aperture / (12 * viscosity);
}

/// Transmissivity of a path between two places of a joint whose walls part linearly from one to the other.
/// Along it q = -T(b) dh/dx is constant, so its parts are in series: 1/T is the mean of 1/T(b). The mean of
/// 1/b^3 is (b1 + b2) / (2 b1^2 b2^2).
/// \param from, to  apertures at its ends, b1 and b2 [m]
inline double taperedTransmissivity(double unit_weight, double from, double to, double viscosity) {
    if (from == to) return transmissivity(unit_weight, from, viscosity);
    return unit_weight * 2 * from * from * to * to / ((from + to) * 12 * viscosity);
}

// Of the stated aperture. A joint that has opened so far conducts a thousand times as much. Where tighter
// joints lie in series with it, the head along it is level, and hardly changes any more. Where it alone carries
// the flow, the cap decides: results have a warning.
inline constexpr double kMostOpened = 10;

/// Hydraulic aperture of a joint that has opened or closed: b = b0 + u, but no less than the residual one.
/// Fractures keep that under stress, and the cubic law holds down to it (Witherspoon and others 1980). UDEC
/// has the same rule (Lemos and Lorig 1990, in Mechanics of Jointed and Faulted Rock, Balkema).
/// \param stated          b0, while the joint has not opened [m]
/// \param opened          u, less than zero where it has closed [m]
/// \param residual_share  of b0: the residual aperture
inline double hydraulicAperture(double stated, double opened, double residual_share) {
    return std::clamp(stated + opened, residual_share * stated, kMostOpened * stated);
}

/// Whether kMostOpened limits the aperture.
inline bool isCapped(double stated, double opened) { return stated + opened > kMostOpened * stated; }

/// k at a point of a joint, and its slope by the pressure head [1/m].
struct RelativeConductivity {
    double value = 1, slope = 0;
};

/// Share of its transmissivity that a joint has at a point: 1 under pressure, and above the free surface
/// k = r + (1 - r) / (1 + (p / ramp)^2), Gardner's relation for suction (1958, Soil Science 85, 228). It has no
/// kink, and Newton's method needs that.
/// \param pressure_head  p [m]
/// \param ramp           suction at which the joint conducts a half [m], > 0
/// \param dry            r: what a dry joint keeps
inline RelativeConductivity relativeConductivity(double pressure_head, double ramp, double dry) {
    if (pressure_head >= 0) return {1, 0};
    const double suction = pressure_head / ramp, share = 1 / (1 + suction * suction);
    return {dry + (1 - dry) * share, -(1 - dry) * 2 * suction * share * share / ramp};
}

}  // namespace talus::flow
