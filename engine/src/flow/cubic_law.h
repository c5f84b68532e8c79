#pragma once
// Laminar flow in a joint, and how far a joint is filled.

#include <algorithm>
#include <array>

namespace talus::flow {

/// Discharge per width of joint and per unit gradient of the head: T = rho g b^3 / (12 mu) [m^2/s], the cubic
/// law of parallel walls (Witherspoon, Wang, Iwai and Gale 1980, Water Resources Research 16(6)).
/// \param unit_weight  rho g [N/m^3]
/// \param aperture     hydraulic, b [m]
/// \param viscosity    dynamic, mu [Pa s]
inline double transmissivity(double unit_weight, double aperture, double viscosity) {
    return unit_weight * aperture * aperture * aperture / (12 * viscosity);
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

/// Mean over a triangle of max(0, f), f linear with these values at the corners. With one corner of a sign,
/// f^3 / (3 (f - g) (f - h)) is the mean over that corner's side of the zero line.
inline double meanPositive(std::array<double, 3> f) {
    std::sort(f.begin(), f.end());
    const double mean = (f[0] + f[1] + f[2]) / 3;
    if (f[0] >= 0) return mean;
    if (f[2] <= 0) return 0;
    if (f[1] <= 0) return f[2] * f[2] * f[2] / (3 * (f[2] - f[0]) * (f[2] - f[1]));
    return mean - f[0] * f[0] * f[0] / (3 * (f[1] - f[0]) * (f[2] - f[0]));
}

/// Share of a triangle that carries water: the mean of a ramp that rises from 0 to 1 while the pressure head
/// rises from -ramp to zero. A joint under pressure is full. As the ramp goes to nothing, this is the share
/// of the area below the free surface.
/// \param pressure_head  at the corners [m]
/// \param ramp           its width [m], > 0
inline double wetShare(const std::array<double, 3>& pressure_head, double ramp) {
    const auto shifted = [&](double by) {
        return meanPositive({pressure_head[0] + by, pressure_head[1] + by, pressure_head[2] + by});
    };
    if (std::min({pressure_head[0], pressure_head[1], pressure_head[2]}) >= 0) return 1;
    return std::clamp((shifted(ramp) - shifted(0)) / ramp, 0.0, 1.0);
}

}  // namespace talus::flow
