#pragma once
// Joints to which a formula without memory applies.

#include "talus/model.h"

namespace talus {

/// Strength is the same before and after failure: no peak to lose, no tension, no dilation. With a peak,
/// failure is progressive and limit equilibrium only an upper bound.
inline bool isPlainCoulomb(const Joint& joint) {
    return joint.law == StrengthLaw::coulomb && joint.tensile_strength == 0 && joint.dilation == 0 &&
           joint.residual_cohesion >= joint.cohesion && joint.residual_friction >= joint.friction;
}

/// The joint has no strength in tension, or in shear without normal force.
inline bool partsFreely(const Joint& joint) {
    return joint.tensile_strength == 0 && joint.cohesion == 0 && joint.dilation == 0;
}

}  // namespace talus
