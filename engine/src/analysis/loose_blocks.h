#pragma once
// Blocks that fall whatever the strength: they are named and taken out, and an analysis goes on with the rest.

#include <cstddef>
#include <string>
#include <vector>

#include "talus/analysis.h"

namespace talus::analysis {

/// Strength is divided by this for the question whether a block has any equilibrium at all.
inline constexpr double kTenfoldStrength = 0.1;

/// Of the free blocks' mass: when more than that would fall, it is the slope that fails and not a loose block.
inline constexpr double kMostLoose = 0.2;

/// One entry per block: whether it has one of these names.
std::vector<char> blocksNamed(const Model& model, const std::vector<std::string>& names);

/// As the public one. \param gone one entry per block
Model withoutBlocks(const Model& model, const std::vector<char>& gone);

/// Share of the mass of free blocks that the marked ones have, 0..1.
double looseShare(const Model& model, const std::vector<char>& gone);

}  // namespace talus::analysis
