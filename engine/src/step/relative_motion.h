#pragma once
// Relative motion of two blocks at a contact, and an impulse that takes energy from it.

#include "state/arrays.h"

namespace talus {

/// The deepest contact point of an interface.
struct DeepestPoint {
    Vec3 place = Vec3::Zero();  ///< [m]
    double depth = 0;           ///< of its spring, negative when open [m]
};
DeepestPoint deepestPoint(const State& state, std::size_t interface);

/// Relative motion of the two blocks of an interface at a place.
struct RelativeMotion {
    Vec3 direction = Vec3::Zero();
    double speed = 0;     ///< of b over a [m/s]
    double mobility = 0;  ///< change of that per impulse along it [1/kg]

    /// Largest energy that an impulse can take from it [J].
    double energy() const { return mobility > 0 ? 0.5 * speed * speed / mobility : 0.0; }
};
RelativeMotion motionAt(const State& state, std::size_t interface, const Vec3& place);

/// Takes energy out of that motion by an impulse and its opposite: momentum and angular momentum stay as they
/// are.
/// \pre 0 <= energy < motion.energy() [J]
/// Writes: velocity, angular_momentum
void takeEnergy(State& state, std::size_t interface, const Vec3& place, const RelativeMotion& motion,
                double energy);

}  // namespace talus
