#pragma once
// What a force on blocks says of itself. Whoever sums forces, solves for equilibrium, bounds the time step,
// measures energy, writes frames or reports asks through this and knows no force by name; the list of all is
// in sum.cpp.

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "forces/tie.h"
#include "forces/wrench.h"
#include "state/arrays.h"
#include "talus/frame.h"
#include "talus/result.h"
#include "talus/supports.h"

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
    /// What it can do at most, for limit analysis. Error: why limit analysis is not made for it.
    Result<std::vector<TieLimit>> (*limits)(const State& state);
};

/// What a force remembers beside load and poses: all that a restart needs to go on to the bit.
struct ForceMemory {
    /// The force's own names of the arrays; none when the model has nothing of the force.
    std::vector<ForceArray> (*read)(const State& state);
    /// \pre  names and sizes as `read` gives them for the model
    void (*write)(State& state, std::span<const ForceArray> arrays);
};

/// A force of things that people look at one by one (talus/supports.h).
struct SupportingForce {
    const char* kind;  ///< as results call the list of them
    std::vector<SupportReport> (*reports)(const State& state);
    /// Of all of them, in the order of `reports`.
    SupportLines (*lines)(const State& state);
};

/// A force on some blocks. Its parts are those of the state at its place in the list; what it needs no
/// function for is nullptr.
struct BlockForce {
    const char* name;
    /// Finds out where it acts, once the interfaces of a model that was just built are known.
    std::vector<Error> (*build)(State& state, ForceParts& parts);
    /// The blocks it acts on, ascending.
    std::span<const std::int32_t> (*blocks)(const State& state, const ForceParts& parts);
    /// On one block, as last brought up to date; zero on one it does not act on.
    Wrench (*on)(const State& state, const ForceParts& parts, std::size_t block);
    /// Brings it up to date with load, time and poses, once a step. Writes what is the force's own.
    void (*update)(State& state) = nullptr;
    /// What changes for good (water that runs out), between steps of a time history.
    void (*look)(State& state) = nullptr;
    /// The same as `on` of one that keeps its direction while its block turns; nullptr: it turns with the
    /// block.
    DeadForce (*dead)(const State& state, const ForceParts& parts, std::size_t block) = nullptr;
    const TyingForce* tying = nullptr;  ///< one between two blocks; nullptr: it comes from outside
    const ForceMemory* memory = nullptr;
    const SupportingForce* supporting = nullptr;
};

}  // namespace talus
