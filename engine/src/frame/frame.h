#pragma once
// The state as frames (talus/frame.h), and back.

#include "state/arrays.h"
#include "talus/frame.h"
#include "talus/result.h"

namespace talus {

RunGeometry geometryOf(const State& state);

/// Energies, poses, velocities and water tables of a state.
LightFrame lightFrameOf(const State& state);

/// All arrays of a state, with its hash; `progress` is the run's business.
FullFrame fullFrameOf(const State& state);

/// Puts a full frame in place of what moves in `state`, which was built from the same model.
/// Errors: a frame whose arrays do not fit each other or the model, so that no frame, whatever its source,
/// can lead the engine out of its arrays; or whose hash is not that of its arrays.
std::vector<Error> restoreFrame(const FullFrame& frame, State& state);

}  // namespace talus
