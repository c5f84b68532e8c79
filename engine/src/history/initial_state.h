#pragma once
// Where a time history starts from.

#include "state/arrays.h"
#include "talus/control.h"
#include "talus/simulation.h"

namespace talus::history {

/// Brings a model that has just been built to the state it is in when its history starts: weight and water of
/// time 0 are put on slowly, so that nothing rattles which nobody has pushed (laid on at once they would make
/// every block bounce on its joints, and a block that bounces on a slope creeps down it).
///  - equilibrium: at rest under its weight, with the strengths it has;
///  - held: there is no such equilibrium; at rest with joints that do not give way, and let go at time 0;
///  - unstressed: as built, when asked for, without gravity, or when a free block touches nothing.
/// Velocities and time are those of the start afterwards. Once it was asked to stop the state is to be thrown
/// away: building it anew would take as long as it took before.
/// \pre the state is as `buildState` gives it
InitialState bringToStart(State& state, const Control& control, bool parallel);

}  // namespace talus::history
