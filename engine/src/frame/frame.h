#pragma once
// The state as frames (talus/frame.h), and back.

#include "state/arrays.h"
#include "talus/frame.h"
#include "talus/result.h"

namespace talus {

/// \param own_joints  of the model as it was given; others of the state's model are those of wet interfaces
RunGeometry geometryOf(const State& state, std::size_t own_joints);

/// Energies, poses, velocities and water tables of a state.
LightFrame lightFrameOf(const State& state);

/// All arrays of a state, with its hash; the run fills in `progress`.
FullFrame fullFrameOf(const State& state);

/// Replaces the moving part of `state`, which was built from the same model, by a full frame. Errors: a frame
/// whose arrays do not fit each other or the model, so that no frame makes the engine index out of range; a
/// frame whose hash is not that of its arrays.
std::vector<Error> restoreFrame(const FullFrame& frame, State& state);
/// The same for a frame whose joints were exchanged: its hash no longer fits the forces, which follow from
/// them.
std::vector<Error> takeFrame(const FullFrame& frame, State& state);

}  // namespace talus
