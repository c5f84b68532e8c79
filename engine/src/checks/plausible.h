#pragma once
// Checks that no range of a single number can make: quantities of a built model compared with each other.
// Each fault names a field of the model.

#include <optional>
#include <string>
#include <vector>

#include "state/arrays.h"
#include "talus/result.h"

namespace talus::checks {

/// Out-of-balance force over the weight by rounding of the coordinates: eps |x| k A / (m g) with |x| by
/// `coordinateReach`, the largest of the free blocks. \param bounds as `frequencyBounds` gives them
double roundingLevel(const State& state, const std::vector<double>& bounds);

/// Free blocks whose rounding error for their mass would decide a search, if they are small slivers
/// (areSplinters); else none, and the search is refused. \param bounds here and below as `frequencyBounds`
/// gives them
std::vector<std::size_t> splintersOfRounding(const State& state, double load_tolerance,
                                             const std::vector<double>& bounds);

/// Faults of a history: water far outside the model.
/// \pre here and below: the state is as `buildState` gives it
std::vector<Error> implausible(const State& state);

/// Doubts, values that are probably not intended. Joints are so soft that a block sinks a tenth of its size
/// under its own weight, or dilate by more than their friction. Water wets no free block or stands high above
/// the model. Nothing holds the blocks.
/// \param over_time  levels above joints at each entry of their tables; else at time 0
std::vector<std::string> doubts(const State& state, bool over_time = false);

/// The same over time, the block that makes a history's steps many times shorter than the median block would,
/// and joints that become weaker than the one chosen at time 0.
std::vector<std::string> doubtsOfHistory(const State& state, bool parallel);

/// Loads that press a block into its joints by a tenth of its size; its weight has the same limit. A force is
/// spread over a mean face; a pressure acts as it is on any number of faces. Fault of a search, doubt of a
/// history.
std::vector<Error> strongLoads(const State& state);

/// A model in which every block falls, so that no search has an answer.
std::optional<Error> nothingHolds(const Model& model);

/// Faults of a search. `load_tolerance`, a change of the out-of-balance force over the weight, must exceed
/// rounding. Joints must be so stiff that weight alone displaces no block as far as a failure. No joint may
/// gain work as it slides, and something must hold the blocks.
std::vector<Error> implausibleSearch(const State& state, double load_tolerance,
                                     const std::vector<double>& bounds);

}  // namespace talus::checks
