#pragma once
// Stages "drift" and "gather": the equations of motion (eqs 3-4) by a symplectic second-order step,
// kick-drift-kick.

#include "state/arrays.h"
#include "state/range.h"

namespace talus {

/// Half kick with the forces of the last step, then the poses move by dt.
/// Reads:  force, torque, inverse masses, velocity, angular_momentum, pose
/// Writes: velocity, angular_momentum, angular_velocity, pose
void drift(State& state, Range blocks, double time_step);

/// Sums the forces on each block (forces/sum.h), wrenches in stored order, adds local damping, and gives the
/// second half kick.
/// Reads:  interface wrenches, what blockForces read
/// Writes: force, torque, velocity, angular_momentum
void gather(State& state, Range blocks, double time_step);

/// A gather and the drift of the next step, in one pass over the blocks; the same bits. Blocks read nothing
/// of each other. Reads and writes: as the two
void gatherAndDrift(State& state, Range blocks, double time_step);

}  // namespace talus
