#pragma once
// Warnings of water that stands higher than the joint that holds it.

#include <string>
#include <vector>

#include "state/arrays.h"
#include "talus/result.h"

namespace talus::checks {

/// A water of no depth and without heads: that of a joint known to be dry.
bool isNothing(const Water& water);

/// Waters whose level stands above the upper end of their joint. Water in another joint that reaches so high,
/// a reservoir or a table may feed them; then there is no warning. \pre the state is as `buildState` gives it
/// \param over_time  at each entry of their tables, the farthest above with its time; else at time 0
std::vector<Error> levelsAboveJoints(const State& state, bool over_time = false);

/// Whether a warning is one of these, of this water.
bool isOfLevelAboveJoint(const std::string& warning, const Water& water);

}  // namespace talus::checks
