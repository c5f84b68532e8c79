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

/// Their numbers, ascending.
std::vector<std::size_t> numbersOf(const Model& model, const std::vector<std::string>& names);

/// As the public one. \param gone one entry per block
Model withoutBlocks(const Model& model, const std::vector<char>& gone);

/// Share of the mass of free blocks that the marked ones have, 0..1.
double looseShare(const Model& model, const std::vector<char>& gone);

/// [kg]
double freeMass(const State& state);
double massOf(const State& state, const std::vector<std::size_t>& blocks);

/// Whether free blocks are splinters, all of them together: a thousandth of the free blocks' mass at most.
bool areSplinters(const State& state, const std::vector<std::size_t>& blocks);

/// Whether a bolt ties any of these blocks: taken out it would hold on to where they were. \param blocks  sorted
bool areTied(const State& state, const std::vector<std::size_t>& blocks);

/// Free blocks that are not at rest: more than a hundredth of their own weight is out of balance; sorted.
std::vector<std::size_t> restlessBlocks(const State& state);

/// The same when they are next to nothing of what is free: squeezed between others they may chatter without end. Else empty.
std::vector<std::size_t> restlessSplinters(const State& state);

/// Free blocks that have left the others behind since they all stood: each has gone at least twice as far as any that stays, and all
/// of them have less than a mass; where there are several such sets, the one that is farthest ahead; sorted. Empty: none, as where
/// a slope slides.
std::vector<std::size_t> leavingBlocks(const State& stood, const State& state, double mass);

/// Free blocks that have gone a fiftieth or more of the farthest one's way between two states: what counts as moving (motion_roles.h).
std::vector<std::size_t> movingBlocks(const State& from, const State& to);

}  // namespace talus::analysis
