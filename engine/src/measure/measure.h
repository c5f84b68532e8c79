#pragma once
// What can be measured on a state: energies, out-of-balance force, displacements, the state hash.

#include <array>
#include <cstdint>
#include <functional>

#include "state/arrays.h"

namespace talus {

double kineticEnergy(const State& state);  ///< with the inertia used in the motion [J]
double elasticEnergy(const State& state);  ///< in contacts and bolts [J]
/// Potential of weight, pseudo-static earthquake and forces that keep their direction, as large as they are
/// now, relative to the initial poses of free blocks [J].
double gravityEnergy(const State& state);

/// Largest out-of-balance force of a free block over its weight; torque counts over weight times the block's
/// radius.
double outOfBalanceRatio(const State& state);
/// Of one block. \param acceleration  bodyAcceleration of the state
double outOfBalanceRatio(const State& state, std::size_t block, const Vec3& acceleration);

/// Whether positions and velocities are finite.
bool isFinite(const State& state);

/// xxh3-64 over poses, velocities, and contact point forces and states.
std::uint64_t stateHash(const State& state);

/// Hashed values of a contact point: F_n, F_s along both tangents, plastic slide along both, bond.
using PointNumbers = std::array<double, 6>;
/// Calls a function with each contact point in stored order; a list of all would take more than a gigabyte
/// for a million blocks.
using EachPoint = std::function<void(const std::function<void(const PointNumbers&)>&)>;

/// The same from what it is made of.
std::uint64_t stateHash(const Blocks& blocks, const EachPoint& points);

}  // namespace talus
