#pragma once
// The water table of a slope: a line over x, extruded along y, or an open surface of triangles, below which
// every face of a free block feels pressure.
//
// Depth is measured along gravity, so pressure is linear below a piece of the line, or a triangle. The planes
// along gravity through its ends, or edges, bound the region below it. Under all faces of a block the sum is
// exactly the pressure's integral over its surface: buoyancy, where the table is level. Where another water
// stands on a wall it is felt instead, so the table's pressure on that polygon is taken off again.
//
// Reads:  the model's surface, shapes, poses, wet; load.tilt, load.water_share, gravity
// Writes: state.phreatic

#include <array>
#include <span>
#include <vector>

#include "forces/wrench.h"
#include "geometry/face_frame.h"
#include "geometry/polygon.h"
#include "geometry/pressure.h"
#include "state/arrays.h"
#include "talus/frame.h"
#include "talus/result.h"

namespace talus::phreatic {

/// A plane along gravity; its two neighbours share it with opposite signs, so a point in it belongs to one of
/// them only.
struct Side {
    Vec3 normal = Vec3::UnitX();  ///< unit
    double offset = 0;            ///< [m]
    double sign = 1;              ///< inside: sign (normal . x - offset) <= 0
};

/// Pressure below one piece, in the state's coordinates: p = max(0, p0 + gradient . x) between its sides.
struct Cell {
    double p0 = 0;                 ///< [Pa]
    Vec3 gradient = Vec3::Zero();  ///< [Pa/m]
    double steepest = 0;           ///< the size of that
    std::array<Side, 3> sides{};
    int side_count = 0;
};

/// All of them. Those of a mesh are found by place: in bins over the plane across gravity.
struct Cells {
    std::vector<Cell> all;
    Vec3 u = Vec3::UnitX(), v = Vec3::UnitY();  ///< across gravity
    Vec2 low = Vec2::Zero();                    ///< of the bins [m]
    double bin = 0;                             ///< their size; 0: there are none [m]
    int columns = 0, rows = 0;
    std::vector<std::size_t> bin_begin;
    std::vector<std::int32_t> in_bin;
};

/// A face of a block, with its frame told in the block's own.
struct Outline {
    FaceFrame frame;
    Polygon corners;   ///< in the frame's plane
    double reach = 0;  ///< of the farthest corner from the frame's origin [m]
};
/// Of a face of a shape in the block's own frame.
Outline outlineIn(const Polyhedron& shape, std::size_t face);

/// \param down  along gravity
/// \param unit_weight  of the water, times the factor of the head [N/m^3]
Cells cellsOf(const PhreaticSurface& surface, const Vec3& down, double unit_weight, const Vec3& origin);

/// On a block's face, about the block's centroid, model frame [N, N m]. \param position, turn  of the block
Wrench pressureOn(const Cells& cells, const Outline& face, const Vec3& position, const Mat3& turn);

/// Of a face's polygon below the surface, where its pressure is more than nothing [m^2].
double wetArea(const Cells& cells, const Polygon& polygon, const FaceFrame& face);

/// Errors: a surface that folds back when it is seen along gravity, a mesh that does not reach over a free
/// block.
std::vector<Error> build(State& state, ForceParts& parts);
void update(State& state);
/// Dries the walls of joints that have opened wider than the surface allows.
void drain(State& state);

/// Which walls are dry for good.
std::vector<ForceArray> memory(const State& state);
void remember(State& state, std::span<const ForceArray> arrays);

inline std::span<const std::int32_t> blocks(const State&, const ForceParts& parts) { return parts.block; }
Wrench on(const State& state, const ForceParts& parts, std::size_t block);

}  // namespace talus::phreatic
