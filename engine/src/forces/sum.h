#pragma once
// The one list of forces on blocks: weight, contacts, and what stands in kBlockForces. A new force is a file of its
// own that says what it reads and writes, and a line there.
//
// Weight and contacts act on every block, so the sum of a step takes them in its kernel (step/motion_kernel.h); the
// others act on some blocks only and are added to those.

#include <array>
#include <span>

#include "forces/wrench.h"
#include "state/arrays.h"

namespace talus {

/// A force on some blocks.
struct BlockForce {
    const char* name;
    /// Brings it up to date with load, time and poses, once a step. Writes what is the force's own.
    void (*update)(State& state);
    /// The blocks it acts on, ascending.
    std::span<const std::int32_t> (*blocks)(const State& state);
    /// On one block, as last brought up to date; zero on one it does not act on.
    Wrench (*on)(const State& state, std::size_t block);
};

extern const std::array<BlockForce, 1> kBlockForces;

/// Brings all of them up to date.
void updateBlockForces(State& state);

/// Gravity as the load has it now [m/s^2].
Vec3 gravity(const State& state);

/// What acts on a block from outside: weight and kBlockForces.
Wrench appliedOn(const State& state, std::size_t block, const Vec3& gravity);

/// Of contacts, weight and kBlockForces, without local damping.
Wrench outOfBalance(const State& state, std::size_t block, const Vec3& gravity);

}  // namespace talus
