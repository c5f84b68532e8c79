#pragma once
// Pressure of steady flow on the walls of joints (flow/flow_in.h), found once for the model as it is built.
//
// Pressure is linear on each triangle of the mesh, so its integral is exact. It pushes both blocks apart
// along the joint's normal. The sum on a block stays as it is in the block's own frame: it turns with the
// block, and does not change while the block slides, opens a joint or is tilted.
//
// Reads:  the model's flow; at the start shapes, poses and interfaces; then load.water_share, orientations
// Writes: its parts, at the build

#include <span>
#include <vector>

#include "forces/wrench.h"
#include "state/arrays.h"
#include "talus/flow.h"
#include "talus/result.h"

namespace talus::flow_water {

/// A water that wets a face which also bounds the network.
/// \pre the walls of waters are made
std::vector<Error> conflicts(const State& state, const Flow& flow);

/// Of a linear pressure on a triangle: its force along the normal, through this point.
struct TrianglePush {
    double force = 0;            ///< integral of max(0, p) dA [N]
    Vec3 moment = Vec3::Zero();  ///< integral of max(0, p) (x - first corner) dA [N m]
};
TrianglePush pushOn(const std::array<Vec3, 3>& corners, const std::array<double, 3>& pressure);

/// Errors: as of flowIn, and conflicts.
std::vector<Error> build(State& state, ForceParts& parts);
inline std::span<const std::int32_t> blocks(const State&, const ForceParts& parts) { return parts.block; }
Wrench on(const State& state, const ForceParts& parts, std::size_t block);

}  // namespace talus::flow_water
