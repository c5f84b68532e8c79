#pragma once
// The record of a history at one moment.

#include <vector>

#include "state/arrays.h"
#include "talus/simulation.h"

namespace talus::history {

BlockReport reportOn(const State& state, std::size_t block);

/// Of the names in the model's `run.watch`, in their order.
std::vector<std::size_t> watchedBlocks(const Model& model);

/// Energies, out-of-balance force, the watched blocks, supports, the ground's motion.
HistoryRecord recordOf(const State& state, const std::vector<std::size_t>& watched);

}  // namespace talus::history
