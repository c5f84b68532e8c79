#pragma once
// The water table of a slope: a line over x, extruded along y, below which every face of a free block feels pressure.
//
// Depth is measured along gravity, so between two points of the line pressure is linear, and the planes through the points
// along gravity and y divide what lies below into strips with one linear pressure each. Under all faces of a block the sum is
// exactly the pressure's integral over its surface: buoyancy, where the line is level. Where another water stands on a wall it
// is felt instead, so the line's pressure on that polygon is taken off again.
//
// Reads:  the model's surface, shapes, poses, wet; load.tilt, load.water_share, gravity
// Writes: state.phreatic

#include <span>
#include <vector>

#include "forces/wrench.h"
#include "geometry/pressure.h"
#include "state/arrays.h"
#include "talus/frame.h"
#include "talus/result.h"

namespace talus::phreatic {

/// One strip of the surface, in the state's coordinates: p = max(0, p0 + gradient . x) where low <= across . x <= high.
struct Strip {
    double p0 = 0;                 ///< [Pa]
    Vec3 gradient = Vec3::Zero();  ///< [Pa/m]
    Vec3 across = Vec3::UnitX();
    double low = -kInfinity, high = kInfinity;  ///< [m]
};

/// \param down  along gravity
/// \param unit_weight  of the water, times the factor of the head [N/m^3]
std::vector<Strip> stripsOf(const PhreaticSurface& surface, const Vec3& down, double unit_weight,
                            const Vec3& origin);

/// On a block's face, about a centroid, model frame.
Wrench pressureOn(const std::vector<Strip>& strips, const Polyhedron& shape, std::size_t face,
                  const Vec3& position, const Mat3& turn);

/// Errors: a line that folds back when it is seen along gravity.
std::vector<Error> build(State& state, ForceParts& parts);
void update(State& state);
/// Walls of joints that have opened wider than the surface allows run dry.
void drain(State& state);

/// Which walls are dry for good.
std::vector<ForceArray> memory(const State& state);
void remember(State& state, std::span<const ForceArray> arrays);

inline std::span<const std::int32_t> blocks(const State&, const ForceParts& parts) { return parts.block; }
Wrench on(const State& state, const ForceParts& parts, std::size_t block);

}  // namespace talus::phreatic
