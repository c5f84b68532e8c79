#pragma once
// The rock face of a model, for its stereonet.

#include <optional>

#include "talus/kinematics.h"
#include "talus/model.h"

namespace talus::tools {

/// Outer faces that dip less are benches and ground [rad].
inline constexpr double kLeastFaceDip = 0.52359877559829887;  // 30 degrees

/// The area-weighted mean of the blocks' outer faces that face upwards and dip by at least kLeastFaceDip, in
/// their position under gravity. A plane with faces on one side only is outer; upright planes with the whole
/// model behind them are where the model was cut off. Nothing where no such face exists.
std::optional<kinematics::Face> faceOf(const Model& model);

}  // namespace talus::tools
