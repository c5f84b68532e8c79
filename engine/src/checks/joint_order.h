#pragma once
// Warnings of joints that become weaker than the one that was chosen between two faces.

#include <vector>

#include "state/arrays.h"
#include "talus/result.h"

namespace talus::checks {

/// Pairs of joints that meet between faces, where the one with less friction at time 0 is not the one with
/// less at another entry of their strengths over time. A history keeps the joint of time 0. Each pair once,
/// at the entry where the other is weakest beside it.
/// \pre the state is as `buildState` gives it
std::vector<Error> weakerLater(const State& state);

}  // namespace talus::checks
