#include "frame/frame_readings.h"

#include <algorithm>
#include <cmath>

#include "forces/contact_forces.h"
#include "forces/water.h"
#include "forces/wet_walls.h"
#include "state/point_layout.h"

namespace talus {
namespace {

// A slipping contact point sits on its strength to rounding.
constexpr double kSlips = 1.0 - 1e-9;
constexpr double kSamePlane = 1e-6;  // of the patch's extent; normals likewise

/// The contact points of one interface.
struct PointRange {
    std::size_t begin, end;
};

/// The interface's plane in the frame of one of its blocks; `outward` tells whether e1 x e2 leaves that
/// block.
struct Side {
    std::size_t block = 0;
    Vec3 origin, e1, e2;
    bool outward = true;

    Vec3 at(double xi, double eta) const { return origin + xi * e1 + eta * e2; }
};

Side sideOf(const Interfaces& f, std::size_t i, bool second) {
    const InterfaceFrame frame = f.frame(i);
    if (!second)
        return {static_cast<std::size_t>(f.block_a[i]), frame.origin_a, frame.e1_a, frame.e2_a, true};
    return {static_cast<std::size_t>(f.block_b[i]), frame.origin_b, frame.e1_b, frame.e2_b, false};
}

/// Coordinates in the plane of a wet patch.
Vec2 onWall(const WetPatches& wet, std::size_t w, const Vec3& x) {
    const Vec3 d = x - wet.origin.get(w);
    return {d.dot(wet.e1.get(w)), d.dot(wet.e2.get(w))};
}

bool inPlaneOf(const WetPatches& wet, std::size_t w, const Side& side, double length) {
    const Vec3 wall = wet.e1.get(w).cross(wet.e2.get(w));
    const Vec3 normal = (side.outward ? 1.0 : -1.0) * side.e1.cross(side.e2).normalized();
    return wall.dot(normal) > 1.0 - kSamePlane &&
           std::abs((side.origin - wet.origin.get(w)).dot(wall)) <= kSamePlane * length;
}

/// The patch's corners on the wall, counter-clockwise there.
Polygon patchOnWall(const State& state, std::size_t i, std::size_t w, const Side& side) {
    std::vector<Vec2> outline = patchOutline(state.interfaces, i);
    if (!side.outward) std::reverse(outline.begin(), outline.end());
    Polygon polygon;
    for (const Vec2& v : outline) polygon.push(onWall(state.wet, w, side.at(v.x(), v.y())));
    return polygon;
}

/// Shares out the exact thrust by area times pressure; by area alone where the water only reaches between the
/// contact points.
void shareOut(const State& state, PointRange range, std::size_t w, const Side& side, double thrust,
              FramePoints& points) {
    const WallPressure pressure = pressureOnWall(state, w);
    const auto weight = [&](std::size_t p) {
        const Vec2 place = onWall(state.wet, w, side.at(points.xi[p], points.eta[p]));
        return points.area[p] * std::max(0.0, pressure.at(place));
    };
    double sum = 0, area = 0;
    for (std::size_t p = range.begin; p < range.end; ++p) sum += weight(p), area += points.area[p];
    for (std::size_t p = range.begin; p < range.end; ++p)
        points.water[p] += static_cast<float>(thrust * (sum > 0 ? weight(p) / sum : points.area[p] / area));
}

/// Adds the waters that stand on one side of an interface; false when there are none.
bool addWaterOf(const State& state, std::size_t i, PointRange range, const Side& side, FramePoints& points) {
    const double length = std::sqrt(state.interfaces.area[i]);
    bool any = false;
    for (auto k = state.incidence.wet_begin[side.block]; k < state.incidence.wet_begin[side.block + 1]; ++k) {
        const auto w = static_cast<std::size_t>(state.incidence.wet[static_cast<std::size_t>(k)]);
        if (!inPlaneOf(state.wet, w, side, length)) continue;
        any = true;
        const Polygon common = intersect(patchOnWall(state, i, w, side), wetPolygon(state.wet, w));
        if (common.empty()) continue;
        const double thrust = pressureOnWall(state, w).on(common).force;
        if (thrust > 0) shareOut(state, range, w, side, thrust, points);
    }
    return any;
}

/// Of each contact point, its area with cohesion over its own; empty: all of it.
std::vector<double> cohesiveAreas(const State& state, std::size_t i) {
    std::vector<double> areas;
    if (!isDistributed(state) || !isPartlyOpen(state, i)) return areas;
    for (const ContactPoint& point : contactPoints(state, i)) areas.push_back(point.cohesive);
    return areas;
}

void addStrength(const contact::JointLaw& law, PointRange range, const std::vector<double>& cohesive,
                 FramePoints& points) {
    for (std::size_t p = range.begin; p < range.end; ++p) {
        const double share = cohesive.empty() ? 1.0 : cohesive[p - range.begin];
        const double strength =
            contact::shearStrength(law, points.area[p], points.normal[p], points.bond[p], share);
        const double shear = std::hypot(points.shear_1[p], points.shear_2[p]);
        const bool open = points.normal[p] == 0 && shear == 0;
        points.state[p] = open                                         ? PointState::open
                          : strength > 0 && shear >= kSlips * strength ? PointState::slipping
                                                                       : PointState::sticking;
        points.mobilised[p] = strength > 0 ? static_cast<float>(std::min(1.0, shear / strength)) : 0.0F;
    }
}

}  // namespace

void addReadings(const State& state, const FrameInterfaces& interfaces, FramePoints& points) {
    points.water.assign(points.size(), 0.0F);
    points.state.assign(points.size(), PointState::open);
    points.mobilised.assign(points.size(), 0.0F);
    for (std::size_t i = 0; i < state.interfaces.size(); ++i) {
        const PointRange range{static_cast<std::size_t>(interfaces.point_begin[i]),
                               static_cast<std::size_t>(interfaces.point_begin[i + 1])};
        addStrength(state.laws[static_cast<std::size_t>(state.interfaces.joint[i])], range,
                    cohesiveAreas(state, i), points);
        if (state.wet.size() == 0) continue;
        // Both walls of a fissure have the same water: it counts once.
        if (!addWaterOf(state, i, range, sideOf(state.interfaces, i, false), points))
            addWaterOf(state, i, range, sideOf(state.interfaces, i, true), points);
    }
}

}  // namespace talus
