#pragma once
// The rock face of a model, for its stereonet.

#include <optional>

#include "talus/kinematics.h"
#include "talus/model.h"

namespace talus::tools {

/// Outer faces that dip less are benches and ground [rad].
inline constexpr double kLeastFaceDip = 0.52359877559829887;  // 30 degrees

/// The mean of the outer faces of the blocks that look upwards and dip by at least kLeastFaceDip, weighted by
/// their area, as they lie under gravity. A plane with faces on one side only is outer; upright planes with
/// the whole model behind them are where the model was cut off. Nothing where no such face exists.
std::optional<kinematics::Face> faceOf(const Model& model);

}  // namespace talus::tools
