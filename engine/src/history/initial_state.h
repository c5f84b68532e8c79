#pragma once
// The initial state of a time history.

#include "state/arrays.h"
#include "talus/control.h"
#include "talus/result.h"
#include "talus/simulation.h"

namespace talus::history {

/// Brings a newly built model to the start of its history. Weight and water of time 0 are applied slowly:
/// applied at once they would make every block bounce on its joints, and a block that bounces on a slope
/// creeps down it.
///  - equilibrium: under its weight, with its own strengths;
///  - held: there is no such equilibrium; that with unbreakable joints, released at time 0;
///  - unstressed: as built, when asked for, without gravity, or when a free block touches nothing.
/// Velocities and time are then those of the start. After an interruption discard the state: building it
/// again takes no longer. Errors: of coupled flow, where there is no equilibrium to begin with.
/// \pre the state is as `buildState` gives it
Result<InitialState> bringToStart(State& state, const Control& control, bool parallel);

}  // namespace talus::history
