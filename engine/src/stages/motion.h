#pragma once
// Stages "drift" and "gather": the equations of motion (eqs 3-4) by a symplectic second-order step, kick-drift-kick.

#include "state/arrays.h"
#include "state/range.h"

namespace talus::stages {

/// Half kick with the forces of the last step, then the poses move by dt.
/// Reads:  force, torque, inverse masses, velocity, angular_momentum, pose
/// Writes: velocity, angular_momentum, angular_velocity, pose
void drift(State& state, Range blocks, double time_step);

/// Angular velocities of the poses and momenta as they are, for when something but a drift has changed them.
/// Writes: angular_velocity
void updateSpin(State& state, Range blocks);

/// Sums the wrenches on each block in stored order, adds weight and local damping, and gives the second half kick.
/// Reads:  interface wrenches, wet wrenches, load
/// Writes: force, torque, velocity, angular_momentum
void gather(State& state, Range blocks, double time_step);

/// A gather and the drift of the next step, in one pass over the blocks; the same bits. Blocks read nothing of each other.
/// Reads and writes: as the two
void gatherAndDrift(State& state, Range blocks, double time_step);

/// Force and torque about a block's centroid, model frame [N, N m].
struct Wrench {
    Vec3 force = Vec3::Zero();
    Vec3 torque = Vec3::Zero();
};
/// Of the water on a block, as last computed.
Wrench waterOn(const State& state, std::size_t block);
/// Of contacts, water and weight, without local damping.
Wrench outOfBalance(const State& state, std::size_t block, const Vec3& gravity);

/// Gravity as the load has it now [m/s^2].
Vec3 gravity(const State& state);

}  // namespace talus::stages
