#pragma once
// Checks of closed volumes of water (Water::closed), and a warning for analyses that hold their level.

#include <string>
#include <vector>

#include "state/arrays.h"
#include "talus/result.h"

namespace talus::checks {

/// Those whose fissure encloses no volume: without walls on both sides up to its level or overflow, or too
/// flat. Not after blocks are removed, when a search holds the level. \pre the state is as `buildState` gives
/// it
std::vector<Error> openVolumes(const State& state);

/// Those whose small opening makes the water a stiff spring for a history's time step, which follows from the
/// joints' stiffness.
std::vector<Error> stiffVolumes(const State& state, bool parallel);

/// The first closed volume of a history without dashpots: friction then amplifies the bouncing of the blocks
/// that slide, until they lift off their beds and slide farther than energy allows.
std::vector<Error> undampedVolumes(const Model& model);

/// Closed volumes that leak where no other water stands: the joint of the leak has no pressure.
std::vector<Error> leaksWithoutPressure(const Model& model);

/// One line per closed volume for an analysis that holds its level.
std::vector<std::string> levelsHeld(const Model& model);

}  // namespace talus::checks
