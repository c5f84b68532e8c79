#pragma once
// Stage "update water": the wrench of fissure water (eqs 1-2) on each wet wall, exact for partly wet polygons.
//
// p = rho_w g (depth below a horizontal table, along gravity). For a joint at tilt beta and a distance s along it that
// is rho_w g cos(beta) (H - s), the paper's eq 16. Walls are polygons fixed to their blocks: water keeps pushing when
// the joint opens.

#include <optional>
#include <span>
#include <vector>

#include "forces/wrench.h"
#include "geometry/pressure.h"
#include "state/arrays.h"
#include "talus/result.h"

namespace talus {

/// Makes the wet walls out of the model's waters and finds which act on which block.
/// Errors: no wall, nothing below the base, two waters on the same place of a wall.
std::vector<Error> buildWater(State& state);

/// Makes the walls again after patches were clipped, for waters that stand on the patch of two blocks.
void rebuildPairWater(State& state);

/// Brings the wrenches up to date where the load, the level or the block's pose changed; nothing to do otherwise.
/// Reads:  load, poses, drained
/// Writes: wet.force, wet.moment
void updateWater(State& state);

/// Blocks with wet walls, ascending.
std::span<const std::int32_t> wetBlocks(const State& state);

/// Of all water on a block, as last computed.
Wrench waterOn(const State& state, std::size_t block);

/// Marks waters as drained whose interfaces have opened wider than they allow. Reads poses, writes drained.
void drainWater(State& state);

/// Pressure in the plane of a wall: hydrostatic, and no more than what falls to nothing where the joint daylights.
struct WallPressure {
    LinearPressure hydrostatic{};
    std::optional<LinearPressure> most{};

    double at(const Vec2& point) const;  ///< without the max with nothing [Pa]
    Thrust on(const Polygon& polygon) const;
};

/// In the plane of a wall, as last computed.
WallPressure pressureOnWall(const State& state, std::size_t wet_patch);

/// What follows of pressures from the rest of them: a restart brings only that. \pre state.wet, state.water_load
void boundPressures(State& state);

/// The pressure of a water under the state's load.
PressureField pressureField(const State& state, std::size_t water);

}  // namespace talus
