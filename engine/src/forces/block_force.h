#pragma once
// The interface of a force on blocks. Sums of forces, equilibrium, the time step, energies, frames and
// reports use only this; the list of all forces is in sum.cpp.

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

/// Additional functions of a force between two blocks.
struct TyingForce {
    std::vector<Tie> (*ties)(const State& state);
    /// Forces of the ties at these poses; changes no memory.
    TieForce (*between)(const State& state, std::size_t tie, const TiedPose& a, const TiedPose& b);
    /// For each tie on a block: the block at the other end, and the elastic stiffness at its point.
    std::vector<std::pair<std::int32_t, TieForce>> (*springsOn)(const State& state, const ForceParts& parts,
                                                                std::size_t block);
    double (*storedEnergy)(const State& state);  ///< [J]
    /// How much farther blocks part until it reaches its full strength [m].
    double (*reach)(const State& state);
    /// Its greatest forces, for limit analysis. Error: why limit analysis does not cover it.
    Result<std::vector<TieLimit>> (*limits)(const State& state);
};

/// Memory of a force beside load and poses: all that a restart needs for the same bits.
struct ForceMemory {
    /// The force's own names of the arrays; none when the model has nothing of the force.
    std::vector<ForceArray> (*read)(const State& state);
    /// \pre  names and sizes as `read` gives them for the model
    void (*write)(State& state, std::span<const ForceArray> arrays);
};

/// A force of supports that results list one by one (talus/supports.h).
struct SupportingForce {
    const char* kind;  ///< as results call the list of them
    std::vector<SupportReport> (*reports)(const State& state);
    /// Of all of them, in the order of `reports`.
    SupportLines (*lines)(const State& state);
};

/// A force on some blocks. Its parts in the state have the same index as the force in the list; functions
/// that it does not need are nullptr.
struct BlockForce {
    const char* name;
    /// Finds where it acts, in a newly built model with interfaces.
    std::vector<Error> (*build)(State& state, ForceParts& parts);
    /// The blocks it acts on, ascending.
    std::span<const std::int32_t> (*blocks)(const State& state, const ForceParts& parts);
    /// On one block, as last brought up to date; zero on one it does not act on.
    Wrench (*on)(const State& state, const ForceParts& parts, std::size_t block);
    /// Updates it to load, time and poses, once a step. Writes the force's own arrays only.
    void (*update)(State& state) = nullptr;
    /// Irreversible changes (water that drains), between steps of a time history.
    void (*look)(State& state) = nullptr;
    /// The same as `on` of one that keeps its direction while its block turns; nullptr: it turns with the
    /// block.
    DeadForce (*dead)(const State& state, const ForceParts& parts, std::size_t block) = nullptr;
    const TyingForce* tying = nullptr;  ///< one between two blocks; nullptr: it comes from outside
    const ForceMemory* memory = nullptr;
    const SupportingForce* supporting = nullptr;
};

}  // namespace talus
