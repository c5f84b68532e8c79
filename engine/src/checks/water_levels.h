#pragma once
// Warnings of water that stands higher than the joint that holds it.

#include <vector>

#include "state/arrays.h"
#include "talus/result.h"

namespace talus::checks {

/// Waters whose level, at the highest of their times, stands above the upper end of their joint. Water in
/// another joint that reaches so high may feed them; then there is no warning. \pre the state is as
/// `buildState` gives it
std::vector<Error> levelsAboveJoints(const State& state);

}  // namespace talus::checks
