#pragma once
// The one list of forces on blocks: weight, contacts, and what stands in blockForces. A new force is a header of its own
// that says what it reads and writes, and a line in sum.cpp.
//
// What pulls at every block by its mass, and contacts, the sum of a step takes in its kernel (step/motion_kernel.h); the
// others act on some blocks only and are added to those.

#include <span>
#include <vector>

#include "forces/tie.h"
#include "forces/wrench.h"
#include "state/arrays.h"
#include "talus/result.h"

namespace talus {

/// What a force between two blocks has beside what all have.
struct TyingForce {
    std::vector<Tie> (*ties)(const State& state);
    /// What a tie does with its blocks at these poses; nothing is remembered.
    TieForce (*between)(const State& state, std::size_t tie, const TiedPose& a, const TiedPose& b);
    /// Of the ties on a block: the block at the other end, and the elastic stiffness where it pulls.
    std::vector<std::pair<std::int32_t, TieForce>> (*springsOn)(const State& state, const ForceParts& parts,
                                                                std::size_t block);
    double (*storedEnergy)(const State& state);  ///< [J]
    /// How much farther blocks part until all of it holds as much as it can [m].
    double (*reach)(const State& state);
};

/// A force on some blocks. Its parts are those of the state at its place in the list; what it needs no function for is
/// nullptr.
struct BlockForce {
    const char* name;
    /// Finds out where it acts, once the interfaces of a model that was just built are known.
    std::vector<Error> (*build)(State& state, ForceParts& parts);
    /// Brings it up to date with load, time and poses, once a step. Writes what is the force's own.
    void (*update)(State& state);
    /// What changes for good (water that runs out), between steps of a time history.
    void (*look)(State& state);
    /// The blocks it acts on, ascending.
    std::span<const std::int32_t> (*blocks)(const State& state, const ForceParts& parts);
    /// On one block, as last brought up to date; zero on one it does not act on.
    Wrench (*on)(const State& state, const ForceParts& parts, std::size_t block);
    /// The same of one that keeps its direction while its block turns; nullptr: it turns with the block.
    DeadForce (*dead)(const State& state, const ForceParts& parts, std::size_t block);
    /// One between two blocks; nullptr: it comes from outside.
    const TyingForce* tying;
};

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

/// Of blockForces on one block: of all, of those from outside, and of those: that turn with it, that keep their direction.
Wrench blockForcesOn(const State& state, std::size_t block);
Wrench outsideForcesOn(const State& state, std::size_t block);
Wrench turningForcesOn(const State& state, std::size_t block);
DeadForce deadForcesOn(const State& state, std::size_t block);

/// Whether any force keeps its direction, and whether any acts at all.
bool hasDeadForces(const State& state);
bool hasBlockForces(const State& state);

/// Elastic energy of what ties blocks beside contacts [J], and how much farther they part until it holds most [m].
double tieEnergy(const State& state);
double tieReach(const State& state);

/// What every block feels by its mass, as the load has it now: gravity and the pseudo-static earthquake; with the ground's
/// motion [m/s^2].
Vec3 standingAcceleration(const State& state);
Vec3 bodyAcceleration(const State& state);

/// What acts on a block from outside: by its mass, and blockForces that tie it to no other.
Wrench appliedOn(const State& state, std::size_t block, const Vec3& acceleration);

/// Of contacts, mass and blockForces, without local damping.
Wrench outOfBalance(const State& state, std::size_t block, const Vec3& acceleration);

}  // namespace talus
