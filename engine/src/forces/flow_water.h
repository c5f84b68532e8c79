#pragma once
// Pressure of steady flow on the walls of joints (flow/flow_in.h), found once for the model as it is built.
// Where the flow is coupled, an equilibrium may put other pressure in its place (forces/coupled_flow.h).
//
// Pressure is linear on each triangle of the mesh, so its integral is exact. It pushes both blocks apart
// along the joint's normal. The sum on a block stays as it is in the block's own frame: it turns with the
// block, and does not change while the block slides, opens a joint or is tilted.
//
// Reads:  the model's flow; at the start shapes, poses and interfaces; then load.water_share, orientations
//         and coupled_pressure
// Writes: its parts and coupled_pressure, at the build

#include <span>
#include <vector>

#include "forces/wrench.h"
#include "state/arrays.h"
#include "talus/flow.h"
#include "talus/frame.h"
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

/// Share of a triangle's area where a linear pressure is above zero, by that at its corners.
double wetShare(std::array<double, 3> pressure);

/// Of each interface, where the flow of the model as built presses [m^2]; none without a flow.
std::vector<double> wetAreas(const State& built);

/// The push of this flow on each block of the model, in the block's own frame: force [N], and moment about
/// the centroid [N m].
std::vector<double> ownPushes(const State& state, const SteadyFlow& flow);

/// Errors: as of flowIn, and conflicts.
std::vector<Error> build(State& state, ForceParts& parts);
inline std::span<const std::int32_t> blocks(const State&, const ForceParts& parts) { return parts.block; }
Wrench on(const State& state, const ForceParts& parts, std::size_t block);

/// Of coupled flow: what a restart needs of its pressure.
std::vector<ForceArray> memory(const State& state);
void remember(State& state, std::span<const ForceArray> arrays);

}  // namespace talus::flow_water
