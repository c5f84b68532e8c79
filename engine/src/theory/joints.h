#pragma once
// The joint between two faces, and whether a formula without memory applies to it.

#include <optional>

#include "model/joint_choice.h"
#include "talus/model.h"

namespace talus::theory {

/// The joint between two faces (model/joint_choice.h).
const Joint& jointBetween(const Model& model, const JointChoice& choice, const WetFace& a, const WetFace& b);

/// The face of a block whose outward normal is `direction` (to rounding).
std::optional<WetFace> faceTowards(const Model& model, std::int32_t block, const Vec3& direction);

/// Strength is the same before and after failure: no peak to lose, no tension, no dilation. With a peak,
/// failure is progressive and limit equilibrium only an upper bound.
bool isPlainCoulomb(const Joint& joint);

/// The joint has no strength in tension, or in shear without normal force.
bool partsFreely(const Joint& joint);

}  // namespace talus::theory
