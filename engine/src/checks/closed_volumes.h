#pragma once
// Closed volumes of water (Water::closed): which are none, and what analyses make of them.

#include <string>
#include <vector>

#include "state/arrays.h"
#include "talus/result.h"

namespace talus::checks {

/// Those in a fissure that encloses nothing: without walls on both sides up to its level or its overflow, or
/// too flat. None in what is left of a model, where a search holds the level. \pre the state is as
/// `buildState` gives it
std::vector<Error> openVolumes(const State& state);

/// Those whose opening is so small that the water is a stiff spring for a history's time step, which follows
/// from the stiffness of joints.
std::vector<Error> stiffVolumes(const State& state, bool parallel);

/// One line per closed volume for an analysis that holds its level.
std::vector<std::string> levelsHeld(const Model& model);

}  // namespace talus::checks
