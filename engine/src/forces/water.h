#pragma once
// Stage "update water": the wrench of fissure water (eqs 1-2) on each wet wall, exact for partly wet
// polygons.
//
// p = rho_w g (depth below a horizontal table, along gravity). For a joint at tilt beta and a distance s
// along it that is rho_w g cos(beta) (H - s), the paper's eq 16. Walls are polygons fixed to their blocks:
// water keeps pushing when the joint opens.

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

/// Brings the wrenches up to date where the load, the level or the block's pose changed; nothing to do
/// otherwise.
/// Reads:  load, poses, drained
/// Writes: wet.force, wet.moment; of closed volumes what closed_water.h says
void updateWater(State& state);

/// Blocks with wet walls, ascending.
std::span<const std::int32_t> wetBlocks(const State& state);

/// Of all water on a block, as last computed.
Wrench waterOn(const State& state, std::size_t block);

/// Heights of a joint's ends along gravity: where blocks that move bound it, and with what bounds it between
/// fixed blocks [m].
struct MovedEnds {
    double low = 0, low_with_fixed = 0, high = 0, high_with_fixed = 0;
};
/// Nothing where every wall counts (Water::ends_at_free_blocks).
std::optional<MovedEnds> movedEnds(const State& state, std::size_t water);

/// Marks waters as drained whose interfaces have opened wider than they allow. Reads poses, writes drained.
void drainWater(State& state);

/// Pressure in the plane of a wall: hydrostatic, and no more than what falls to nothing where the joint
/// daylights.
struct WallPressure {
    LinearPressure hydrostatic{};
    std::optional<LinearPressure> most{};

    double at(const Vec2& point) const;  ///< without the max with nothing [Pa]
    Thrust on(const Polygon& polygon) const;
};

/// In the plane of a wall, as last computed.
WallPressure pressureOnWall(const State& state, std::size_t wet_patch);

inline constexpr double kPresses = 1e-9;  ///< of a block's weight: water that pushes less is rounding

/// Why a water presses on no free block.
struct DryWater {
    enum class Why : std::uint8_t {
        no_free_wall,        ///< all its walls belong to blocks that are not free
        falls_from_nothing,  ///< it does not stand above its joint's upper end, from where its pressure falls
        table_too_low,       ///< it does not stand above the lowest of its walls on free blocks
        no_head              ///< its heads leave those walls dry
    };
    Why why = Why::no_free_wall;
    double table = 0;  ///< how high it stands, along gravity above the model's origin [m]
    double wall = 0;   ///< likewise: what it does not reach [m]
};

/// At the highest of its levels over time and under the state's tilt; nothing where it presses on a free
/// block.
std::optional<DryWater> whyDry(const State& state, std::size_t water);

/// What follows of pressures from the rest of them: a restart brings only that. \pre state.wet,
/// state.water_load
void boundPressures(State& state);

/// The pressure of a water, by its number, under a load.
PressureField pressureField(const State& state, std::size_t index, const Load& load);

}  // namespace talus
