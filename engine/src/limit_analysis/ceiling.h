#pragma once
// The upper bound of limit analysis for a state.

#include <string>
#include <vector>

#include "state/arrays.h"
#include "talus/limit_analysis.h"

namespace talus::limit {

/// \param state  as built, or settled under its weight: the contacts that are closed count
/// \param always  whatever its size
Ceiling ceilingOf(State& state, Varied load, bool always, const Control& control,
                  const LimitSettings& settings);

}  // namespace talus::limit
