#pragma once
// Warnings of water that stands higher than the joint that holds it.

#include <vector>

#include "state/arrays.h"
#include "talus/result.h"

namespace talus::checks {

/// A water of no depth and without heads: that of a joint known to be dry.
bool isNothing(const Water& water);

/// Waters whose level stands above the upper end of their joint. Water in another joint that reaches so high,
/// a reservoir or a table may feed them; then there is no warning. \pre the state is as `buildState` gives it
/// \param over_time  at the highest of their levels over time; else at those of time 0
std::vector<Error> levelsAboveJoints(const State& state, bool over_time = false);

}  // namespace talus::checks
