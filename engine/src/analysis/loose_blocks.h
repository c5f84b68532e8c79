#pragma once
// Blocks that fall whatever the strength: they are named and taken out, and an analysis goes on with the rest.

#include <cstddef>
#include <string>
#include <vector>

#include "state/arrays.h"
#include "talus/analysis.h"

namespace talus::analysis {

/// By what strength is divided for the question whether a block has any equilibrium at all: then the weakest joint that has
/// friction has one of 80 degrees, and joints that have more than friction ten times their strength.
double strongestFactor(const std::vector<Joint>& joints);

/// Whether joints have Coulomb's friction and nothing else: then scaling it scales all strength.
bool haveFrictionOnly(const std::vector<Joint>& joints);

/// The joints at that factor, the same to the bit whatever share of that strength they have.
/// \pre haveFrictionOnly
std::vector<Joint> strongest(std::vector<Joint> joints);

/// Of the free blocks' mass: when more than that would fall, it is the slope that fails and not a loose block.
inline constexpr double kMostLoose = 0.2;

/// One entry per block: whether it has one of these names.
std::vector<char> blocksNamed(const Model& model, const std::vector<std::string>& names);

/// As the public one. \param gone one entry per block
Model withoutBlocks(const Model& model, const std::vector<char>& gone);

/// Share of the mass of free blocks that the marked ones have, 0..1.
double looseShare(const Model& model, const std::vector<char>& gone);

/// [kg]
double freeMass(const State& state);

/// Whether free blocks are splinters, all of them together: a thousandth of the free blocks' mass at most.
bool areSplinters(const State& state, const std::vector<std::size_t>& blocks);

}  // namespace talus::analysis
