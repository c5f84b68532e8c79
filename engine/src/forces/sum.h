#pragma once
// The one list of forces on blocks: weight, contacts, and those in blockForces. A new force is a header of
// its own that states what it reads and writes, and an entry in sum.cpp (block_force.h has the interface).
//
// The kernel of a step sums body forces and contacts (step/motion_kernel.h); the others act on some blocks
// only and are added there.

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

/// Sum of blockForces on one block: all, those from outside, and of these, those that turn with it and those
/// of fixed direction.
Wrench blockForcesOn(const State& state, std::size_t block);
Wrench outsideForcesOn(const State& state, std::size_t block);
Wrench turningForcesOn(const State& state, std::size_t block);
DeadForce deadForcesOn(const State& state, std::size_t block);

/// Whether any force keeps its direction, and whether any acts at all.
bool hasDeadForces(const State& state);
bool hasBlockForces(const State& state);

/// Elastic energy of the ties between blocks [J], and how much farther blocks part until these reach their
/// full strength [m].
double tieEnergy(const State& state);
double tieReach(const State& state);

/// Greatest forces of all ties. Error: why limit analysis does not cover one of them.
Result<std::vector<TieLimit>> tieLimits(const State& state);

/// Memory of the forces, by the names of force and array; and whether given arrays fit it.
std::vector<ForceArray> forceMemory(const State& state);
bool isForceMemory(const State& state, const std::vector<ForceArray>& memory);
/// \pre isForceMemory
void setForceMemory(State& state, const std::vector<ForceArray>& memory);

/// All supports, kind by kind; and their lines.
std::vector<Supports> supportReports(const State& state);
SupportLines supportLines(const State& state);

/// Body acceleration of every block under the present load: gravity, the pseudo-static earthquake and the
/// ground's motion [m/s^2].
Vec3 standingAcceleration(const State& state);
Vec3 bodyAcceleration(const State& state);

/// External forces on a block: body forces, and blockForces that are no ties.
Wrench appliedOn(const State& state, std::size_t block, const Vec3& acceleration);

/// Of contacts, mass and blockForces, without local damping.
Wrench outOfBalance(const State& state, std::size_t block, const Vec3& acceleration);

}  // namespace talus
