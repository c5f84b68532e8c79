#pragma once
// Blocks that fall whatever the strength: they are named and removed, and an analysis continues with the
// rest.

#include <cstddef>
#include <string>
#include <vector>

#include "state/arrays.h"
#include "talus/analysis.h"

namespace talus::checks {

/// Share of the free blocks' mass: if more would fall, the slope fails and not a loose block.
inline constexpr double kMostLoose = 0.2;

/// One entry per block: whether it has one of these names.
std::vector<char> blocksNamed(const Model& model, const std::vector<std::string>& names);

/// Their numbers, ascending.
std::vector<std::size_t> numbersOf(const Model& model, const std::vector<std::string>& names);

/// As the public function. \param gone one entry per block
Model withoutBlocks(const Model& model, const std::vector<char>& gone);

/// Share of the mass of free blocks that the marked ones have, 0..1.
double looseShare(const Model& model, const std::vector<char>& gone);

/// Whether a block has an interface that is closed.
bool touchesSomething(const State& state, std::size_t block);

/// [kg]
double freeMass(const State& state);
double massOf(const State& state, const std::vector<std::size_t>& blocks);

/// Whether these blocks are small slivers: together at most a thousandth of the free blocks' mass.
bool areSplinters(const State& state, const std::vector<std::size_t>& blocks);

/// Whether a bolt ties any of these blocks: it would stay tied to the place of a removed block. \param blocks
/// sorted
bool areTied(const State& state, const std::vector<std::size_t>& blocks);

/// Free blocks displaced between two states by a fiftieth or more of the largest displacement: what counts as
/// moving (motion_roles.h).
std::vector<std::size_t> movingBlocks(const PositionArray& position, const QuaternionArray& orientation,
                                      const State& to);
inline std::vector<std::size_t> movingBlocks(const State& from, const State& to) {
    return movingBlocks(from.blocks.position, from.blocks.orientation, to);
}

}  // namespace talus::checks
