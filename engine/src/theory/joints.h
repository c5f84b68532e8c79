#pragma once
// The joint between two faces.

#include <optional>

#include "model/joint_choice.h"
#include "talus/model.h"

namespace talus::theory {

/// The joint between two faces (model/joint_choice.h).
const Joint& jointBetween(const Model& model, const JointChoice& choice, const WetFace& a, const WetFace& b);

/// The face of a block whose outward normal is `direction` (to rounding).
std::optional<WetFace> faceTowards(const Model& model, std::int32_t block, const Vec3& direction);

}  // namespace talus::theory
