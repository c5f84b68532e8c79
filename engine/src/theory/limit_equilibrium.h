#pragma once
// Limit equilibrium of one rigid mass on a plane: the two equations every closed formula of theory.h rests
// on.
//
//            z ^   +-------+ <- back: water pushes towards -x (downhill for a positive tilt)
//              |   |  mass |
//              |   +-------+--> x      gravity: (-sin(tilt), 0, -cos(tilt)) g
//
// Water forces are given per cos(tilt): a horizontal water table makes them rho_w g cos(tilt) times a length
// squared.

namespace talus::theory {

/// A rigid mass that stands on one bed, all about that bed and its downhill edge.
struct Mass {
    double weight = 0;          ///< [N]
    double weight_moment = 0;   ///< weight times height of its centroid above the bed [N m]
    double weight_lever = 0;    ///< weight times distance of its centroid from the downhill edge [N m]
    double friction_force = 0;  ///< tan(phi) times (weight - uplift), per cos(tilt) [N]
    double cohesion_force = 0;  ///< C times base area [N]
    double thrust = 0;          ///< net push of the water towards downhill, per cos(tilt) [N]
    double thrust_moment = 0;   ///< its moment about the bed's level, per cos(tilt) [N m]
    double uplift_moment = 0;   ///< moment of the uplift about the downhill edge, per cos(tilt) [N m]
};

/// Solves weight sin(b) + thrust cos(b) = friction_force cos(b) + cohesion_force for b, exactly, as R sin(b -
/// d) = c. Infinity when the mass cannot slide downhill at any tilt.
double slidingTilt(const Mass& mass);

/// tan(b) = (weight_lever - thrust_moment - uplift_moment) / weight_moment: the resultant passes the downhill
/// edge.
double topplingTilt(const Mass& mass);

/// What sliding downhill at this tilt still needs from a support in front; negative: a reserve [N].
double slidingExcess(const Mass& mass, double tilt);

/// What overturning about the downhill edge still needs from a support in front; negative: a reserve [N m].
double topplingExcess(const Mass& mass, double tilt);

}  // namespace talus::theory
