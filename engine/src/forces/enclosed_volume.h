#pragma once
// The volume that the walls of a fissure enclose below a level table of water: pure functions of where the
// walls stand and stood.
//
// A wall is a polygon fixed to a block. While it stands as built the fissure is as wide as its opening b.
// What a wall sweeps as it moves is the room between its plane at the start, with the normal n0, and where it
// is now. With x measured from the plane at the start, s = n0 . x, and the divergence theorem for the field
// s n0, whose divergence is 1 and which runs along the sides of that room:
//
//   V_w = -(n0 . n) integral of s over the wet part of the wall
//         - (tan(gamma) / 2) integral of s^2 along its water line          sin(gamma) = n0 . up
//
// The second term is the surface of the water, which is not normal to a wall that leans or to a tilted one.
// The volume below a table at the height L is
//
//   V(L) = b A(L) + sum of V_w(L),     A: the walls of one side below L, as built, of the larger side
//
// so that dV at a fixed table is the integral of -n . dx over what is wet of the walls, n their outward
// normal. Water of a constant volume and level L has the potential energy U = rho g integral of z dV, and
// with dV = 0
//
//   dU = -(sum over walls) integral of p (-n . dx) dA,     p = rho g (L - z):
//
// the hydrostatic pressure is its derivative (L. D. Landau and E. M. Lifshitz, Fluid Mechanics, section 3).
// That is exact where walls move along n0. Where they also move along themselves by t, the lower edge of
// the room moves with them, and its share of the energy, p s t per m of that edge, is left out.
// Nor is the room exact where the table no longer reaches the plane at the start: a gap s so wide that
// s tan(gamma) exceeds the level. Little water stands there.

#include <cmath>

#include "geometry/face_frame.h"
#include "geometry/pressure.h"

namespace talus {

/// A level table: the plane up . x = height.
struct WaterTable {
    Vec3 up = Vec3::UnitZ();
    double height = 0;  ///< [m]

    /// Depth below it, over a wall's own coordinates [m].
    LinearPressure depthOn(const FaceFrame& plane) const {
        return {height - up.dot(plane.origin), Vec2(-up.dot(plane.e1), -up.dot(plane.e2))};
    }
};

/// Of a wall below a table [m^2].
inline double areaBelow(const Polygon& wall, const FaceFrame& plane, const WaterTable& table) {
    const Polygon wet = wetPart(wall, table.depthOn(plane));
    return wet.empty() ? 0.0 : area(wet);
}

/// Where the line of a table crosses a wall: its ends; none where it does not.
struct WaterLine {
    Vec2 from = Vec2::Zero(), to = Vec2::Zero();
    bool crosses = false;
};
inline WaterLine waterLine(const Polygon& wall, const LinearPressure& depth) {
    WaterLine line;
    int found = 0;
    for (std::size_t k = 0; k < wall.size(); ++k) {
        const Vec2 &a = wall[k], &b = wall.next(k);
        const double at_a = depth.at(a), at_b = depth.at(b);
        if ((at_a > 0) == (at_b > 0)) continue;
        (++found == 1 ? line.from : line.to) = a + at_a / (at_a - at_b) * (b - a);
    }
    line.crosses = found == 2;
    return line;
}

/// V_w: what a wall has given free below a table since the start; negative where it has advanced [m^3].
/// \pre the wall was not level at the start
inline double sweptBelow(const Polygon& wall, const FaceFrame& start, const FaceFrame& now,
                         const WaterTable& table) {
    const LinearPressure depth = table.depthOn(now);
    const Polygon wet = wetPart(wall, depth);
    if (wet.empty()) return 0;
    const auto advance = [&](const Vec2& point) { return start.height(now.toWorld(point)); };  // s
    const double swept = -start.e3.dot(now.e3) * area(wet) * advance(centroid(wet));
    const WaterLine line = waterLine(wall, depth);
    if (!line.crosses) return swept;
    const double sine = start.e3.dot(table.up);
    const Vec3 along = start.e3.cross(table.up).normalized();
    const double length = std::abs(along.dot(now.toWorld(line.to) - now.toWorld(line.from)));
    const double s = advance(line.from), t = advance(line.to);
    return swept - 0.5 * sine / std::sqrt(1 - sine * sine) * length * (s * s + s * t + t * t) / 3;
}

}  // namespace talus
