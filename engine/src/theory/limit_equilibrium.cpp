#include "theory/limit_equilibrium.h"

#include <cmath>

#include "talus/model.h"

namespace talus::theory {

double slidingTilt(const Mass& mass) {
    const double cosine_part = mass.friction_force - mass.thrust;
    const double resultant = std::hypot(mass.weight, cosine_part);
    if (mass.cohesion_force > resultant) return kInfinity;
    return std::atan2(cosine_part, mass.weight) + std::asin(mass.cohesion_force / resultant);
}

double topplingTilt(const Mass& mass) {
    return std::atan2(mass.weight_lever - mass.thrust_moment - mass.uplift_moment, mass.weight_moment);
}

double slidingExcess(const Mass& mass, double tilt) {
    return mass.weight * std::sin(tilt) + (mass.thrust - mass.friction_force) * std::cos(tilt) -
           mass.cohesion_force;
}

double topplingExcess(const Mass& mass, double tilt) {
    return mass.weight_moment * std::sin(tilt) +
           (mass.thrust_moment + mass.uplift_moment - mass.weight_lever) * std::cos(tilt);
}

}  // namespace talus::theory
