#pragma once
// What no range of a single number can say: quantities of a built model held against each other. Each fault is one of the
// model's fields.

#include <optional>
#include <string>
#include <vector>

#include "state/arrays.h"
#include "talus/result.h"

namespace talus::analysis {

/// What rounding of the coordinates leaves of a block's out-of-balance force, over its weight: eps |x| k A / (m g), the
/// largest of the free blocks. \param bounds  as `frequencyBounds` gives them
double roundingLevel(const State& state, const std::vector<double>& bounds);

/// What a time step asked for has to say for itself. Explicit steps gain energy soon above their stability bound: a stack of 106
/// blocks stood still at 1.2 times the bound, crept at 1.6, and had 3e43 J at 6. The bound is no tight one, so steps up to
/// twice that are the user's own risk. \param step, bound  [s]
std::optional<Error> stepTooLong(double step, double bound);

/// Faults of a history: water far outside the model, steps that explode.
/// \pre here and below: the state is as `buildState` gives it
std::vector<Error> implausibleHistory(const State& state, bool parallel);

/// What may be meant, but hardly is: joints so soft that a block sinks a tenth of itself under its own weight, water that wets
/// nothing or stands high above the model, nothing that holds the blocks, joints that dilate by more than their friction.
std::vector<std::string> doubts(const State& state);

/// The same, and the block that makes a history's steps many times shorter than the median block would.
std::vector<std::string> doubtsOfHistory(const State& state, bool parallel);

/// Faults of a search whose answer a change of the out-of-balance force over the weight by `load_tolerance` decides: that has
/// to be more than rounding, joints stiff enough that a block's own weight does not move it as far as a failure does, joints
/// must not gain work as they slide, and something has to hold the blocks.
std::vector<Error> implausibleSearch(const State& state, double load_tolerance, bool parallel);

}  // namespace talus::analysis
