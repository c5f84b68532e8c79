#pragma once
// Levels of water over hours, while the walls stand still.

#include <vector>

#include "state/arrays.h"
#include "talus/analysis.h"

namespace talus::search {

/// Whether a level changes by itself: a closed volume, or a table over time.
bool changes(const Water& water);

/// Depths or elevations of all waters of the model at these times, ascending from 0 [m]. The state stands as
/// built; its closed volumes are those of the last time afterwards. Ends early when it is asked to stop.
/// Reads: poses; writes: load.time, closed
std::vector<std::vector<double>> levelsOver(State& state, const std::vector<double>& times,
                                            const Control& control);

}  // namespace talus::search
