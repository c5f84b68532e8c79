#pragma once
// Stage "update contacts": Lp forces and interface wrenches from the poses.

#include "state/arrays.h"
#include "state/range.h"

namespace talus::stages {

/// \pre  interfaces, points and block poses are those of one instant
/// Reads:  blocks.position, orientation (and velocity, angular_momentum with contact damping); interfaces' frames;
///         points' geometry; laws; release
/// Writes: points' forces and memory; interfaces.force, moment_a, moment_b
/// Each interface writes its own slots only.
void updateContacts(State& state, Range interfaces);

/// Gap at the interface's origin and its slopes along e1 and e2, less the reference gap [m, -, -], and the slide of b
/// over a there along e1, e2 [m] with its gradients.
struct RelativePose {
    Vec3 gap;               ///< gap, d gap/d xi, d gap/d eta
    Vec3 slide_1, slide_2;  ///< likewise
    Vec3 origin;            ///< of the interface, model frame [m]
    Vec3 e1, e2, e3;        ///< model frame
};
RelativePose relativePose(const State& state, std::size_t interface);

/// Angular velocity of a block in the model frame [rad/s].
Vec3 angularVelocity(const Blocks& blocks, std::size_t block);

}  // namespace talus::stages
