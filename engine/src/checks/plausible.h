#pragma once
// What no range of a single number can say: quantities of a built model held against each other. Each fault
// is one of the model's fields.

#include <optional>
#include <string>
#include <vector>

#include "state/arrays.h"
#include "talus/result.h"

namespace talus::checks {

/// What rounding of the coordinates leaves of a block's out-of-balance force, over its weight: eps |x| k A /
/// (m g) with
/// |x| as `coordinateReach` has it, the largest of the free blocks. \param bounds  as `frequencyBounds` gives
/// them
double roundingLevel(const State& state, const std::vector<double>& bounds);

/// Free blocks with so much for their mass that rounding would decide a search, when they are splinters
/// (areSplinters); else none, and the search is refused. \param bounds  here and below as `frequencyBounds`
/// gives them
std::vector<std::size_t> splintersOfRounding(const State& state, double load_tolerance,
                                             const std::vector<double>& bounds);

/// Faults of a history: water far outside the model.
/// \pre here and below: the state is as `buildState` gives it
std::vector<Error> implausible(const State& state);

/// What may be meant, but hardly is: joints so soft that a block sinks a tenth of itself under its own
/// weight, water that wets no free block or stands high above the model, nothing that holds the blocks,
/// joints that dilate by more than their friction.
std::vector<std::string> doubts(const State& state);

/// The same, and the block that makes a history's steps many times shorter than the median block would.
std::vector<std::string> doubtsOfHistory(const State& state, bool parallel);

/// Loads that press a block into its joints by a tenth of its size, as its weight must not either. A force is
/// shared by a mean face; a pressure presses as hard as it is, however many faces it acts on. Fault of a
/// search, doubt of a history.
std::vector<Error> strongLoads(const State& state);

/// A model in which every block falls, so that no search has an answer.
std::optional<Error> nothingHolds(const Model& model);

/// Faults of a search whose answer a change of the out-of-balance force over the weight by `load_tolerance`
/// decides: that has to be more than rounding, joints stiff enough that a block's own weight does not move it
/// as far as a failure does, joints must not gain work as they slide, and something has to hold the blocks.
std::vector<Error> implausibleSearch(const State& state, double load_tolerance,
                                     const std::vector<double>& bounds);

}  // namespace talus::checks
