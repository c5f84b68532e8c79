#pragma once
// The one list of forces on blocks: weight, contacts, and what stands in blockForces. A new force is a header
// of its own that says what it reads and writes, and an entry in sum.cpp (block_force.h says what it may
// hold).
//
// What pulls at every block by its mass, and contacts, the sum of a step takes in its kernel
// (step/motion_kernel.h); the others act on some blocks only and are added to those.

#include <span>
#include <vector>

#include "forces/block_force.h"

namespace talus {

std::span<const BlockForce> blockForces();

/// Makes all of them for a model that was just built.
std::vector<Error> buildBlockForces(State& state);

/// Brings all of them up to date.
void updateBlockForces(State& state);

/// Between two steps of a time history.
void lookAtBlockForces(State& state);

/// Calls with each force and its parts.
template <class Each>
void eachBlockForce(const State& state, const Each& each) {
    for (std::size_t k = 0; k < state.force_parts.size(); ++k) each(blockForces()[k], state.force_parts[k]);
}

/// Of blockForces on one block: of all, of those from outside, and of those: that turn with it, that keep
/// their direction.
Wrench blockForcesOn(const State& state, std::size_t block);
Wrench outsideForcesOn(const State& state, std::size_t block);
Wrench turningForcesOn(const State& state, std::size_t block);
DeadForce deadForcesOn(const State& state, std::size_t block);

/// Whether any force keeps its direction, and whether any acts at all.
bool hasDeadForces(const State& state);
bool hasBlockForces(const State& state);

/// Elastic energy of what ties blocks beside contacts [J], and how much farther they part until it holds most
/// [m].
double tieEnergy(const State& state);
double tieReach(const State& state);

/// What all ties can do at most. Error: why limit analysis is not made for one of them.
Result<std::vector<TieLimit>> tieLimits(const State& state);

/// What forces remember, under the names of force and array; and whether arrays may take its place.
std::vector<ForceArray> forceMemory(const State& state);
bool isForceMemory(const State& state, const std::vector<ForceArray>& memory);
/// \pre isForceMemory
void setForceMemory(State& state, const std::vector<ForceArray>& memory);

/// All that people look at one by one, kind by kind; and their lines.
std::vector<Supports> supportReports(const State& state);
SupportLines supportLines(const State& state);

/// What every block feels by its mass, as the load has it now: gravity and the pseudo-static earthquake; with
/// the ground's motion [m/s^2].
Vec3 standingAcceleration(const State& state);
Vec3 bodyAcceleration(const State& state);

/// What acts on a block from outside: by its mass, and blockForces that tie it to no other.
Wrench appliedOn(const State& state, std::size_t block, const Vec3& acceleration);

/// Of contacts, mass and blockForces, without local damping.
Wrench outOfBalance(const State& state, std::size_t block, const Vec3& acceleration);

}  // namespace talus
