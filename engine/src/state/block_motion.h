#pragma once
// Motion of blocks from their momenta, inertia and poses alone.

#include <vector>

#include "state/arrays.h"
#include "state/range.h"

namespace talus {

/// The inertia used in the motion: the true one times `scale` (one number per block). Velocities stay.
void setInertia(State& state, const std::vector<double>& scale);

/// Free blocks stop.
void setAtRest(Blocks& blocks);

/// Angular velocity of a block in the model frame [rad/s].
Vec3 angularVelocity(const Blocks& blocks, std::size_t block);

/// Angular velocities of the present poses and momenta, after a change by anything but a drift.
/// Writes: angular_velocity
void updateSpin(State& state, Range blocks);

/// No point of a block is faster [m/s].
double speedBound(const State& state, std::size_t block);

/// Velocity of a block's material point at a place of the model frame [m/s].
Vec3 velocityAt(const Blocks& blocks, std::size_t block, const Vec3& place);

/// Angle a block has turned from a given orientation [rad].
double rotationFrom(const QuaternionArray& from, const QuaternionArray& to, std::size_t block);

/// Largest displacement of any point of a block from a given position and orientation, to first order [m].
double wayFrom(const PositionArray& position, const QuaternionArray& orientation, const State& state,
               std::size_t block);

/// Of the farthest-moved point of any free block since it was in other poses [m].
double largestMotion(const State& state, const PositionArray& position, const QuaternionArray& orientation);

/// Axis times angle of the turn from one orientation to another, in the model frame [rad]. The vector part
/// keeps small angles exact; of the two quaternions of a turn the one with the angle below pi counts.
Vec3 rotationVector(const Quaternion& from, const Quaternion& to);

}  // namespace talus
