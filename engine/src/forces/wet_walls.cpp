#include "forces/wet_walls.h"

#include <algorithm>
#include <cmath>

#include "forces/contact_forces.h"
#include "geometry/face_frame.h"
#include "geometry/parts.h"
#include "geometry/pressure.h"
#include "model/gravity.h"
#include "state/incidence.h"

namespace talus {
namespace {

void addPatch(WetPatches& wet, std::size_t block, std::size_t water, std::int32_t interface,
              const FaceFrame& plane, const Polygon& polygon, const Vec3& head) {
    wet.block.push_back(static_cast<std::int32_t>(block));
    wet.water.push_back(static_cast<std::int32_t>(water));
    wet.interface.push_back(interface);
    wet.origin.add(plane.origin);
    wet.e1.add(plane.e1);
    wet.e2.add(plane.e2);
    wet.head.add(head);
    wet.force.add(Vec3::Zero());
    wet.moment.add(Vec3::Zero());
    for (const Vec2& v : polygon) {
        wet.vertex_x.push_back(v.x());
        wet.vertex_y.push_back(v.y());
    }
    wet.vertex_begin.push_back(static_cast<std::int64_t>(wet.vertex_x.size()));
}

/// Two heads, linear over the height at the start between a joint's upper and lower end: where the lower one
/// daylights with none, E. Hoek and J. W. Bray's distribution below a crack full of water.
struct HeadOverHeight {
    double at_zero = 0, slope = 0;  ///< head at the height 0 of the state's z [m], and its rise with height

    /// On a wall: value at the frame's origin and gradient along its e1, e2.
    Vec3 on(const State& state, std::size_t b, const FaceFrame& plane) const {
        const Mat3 turn = state.geometry->initial_orientation.matrix(b);
        const double z = state.geometry->initial_position.get(b).z() + (turn * plane.origin).z();
        return {at_zero + slope * z, slope * (turn * plane.e1).z(), slope * (turn * plane.e2).z()};
    }
};

/// What of a polygon on a block lies in the outline of a fissure, as they stand at the start.
Polygon inOutline(const State& state, const Water& water, std::size_t b, const FaceFrame& plane,
                  const Polygon& polygon) {
    if (water.outline.empty()) return polygon;
    const Mat3 to_own = state.geometry->initial_orientation.matrix(b).transpose();
    const Vec3 centroid = state.geometry->initial_position.get(b) + state.geometry->origin;
    std::vector<Vec2> corners;
    for (const Vec3& corner : water.outline) corners.push_back(plane.toPlane(to_own * (corner - centroid)));
    Polygon outline;
    for (const Vec2& corner : corners) outline.push(corner);
    if (area(outline) < 0) {  // seen from the other side
        outline.clear();
        for (auto corner = corners.rbegin(); corner != corners.rend(); ++corner) outline.push(*corner);
    }
    return intersect(polygon, outline);
}

/// Of a water's walls; none for what is not told by heads.
HeadOverHeight headOverHeight(const State& state, const Water& water) {
    if (water.kind != Water::Level::head || water.pair) return {};
    double low = kInfinity, high = -kInfinity;
    const EndWalls ends(*state.geometry, water);
    for (const WetFace& wall : water.walls) {
        if (!ends.counts(wall.block)) continue;
        const auto b = static_cast<std::size_t>(wall.block);
        const Polyhedron& shape = state.geometry->shape[b];
        const auto face = static_cast<std::size_t>(wall.face);
        const Mat3 turn = state.geometry->initial_orientation.matrix(b);
        const FaceFrame plane = faceFrame(shape, face);
        for (const Vec2& v : inOutline(state, water, b, plane, outlineOf(shape, face))) {
            const double z = state.geometry->initial_position.get(b).z() + (turn * plane.toWorld(v)).z();
            low = std::min(low, z);
            high = std::max(high, z);
        }
    }
    const double slope = high > low ? (water.head[0] - water.head[1]) / (high - low) : 0.0;
    return {water.head[1] - slope * low, slope};
}

/// A polygon on a block, less what lies beyond the fissure or below the water's base at the start.
void addWetPart(State& state, std::size_t water, std::size_t b, const FaceFrame& plane, const Polygon& whole,
                const HeadOverHeight& head) {
    const Water& description = state.geometry->model.waters[water];
    const double base = description.base - state.geometry->origin.z();
    Polygon polygon = inOutline(state, description, b, plane, whole);
    if (base > -kInfinity) {
        const Mat3 turn = state.geometry->initial_orientation.matrix(b);
        const Vec3 origin = state.geometry->initial_position.get(b) + turn * plane.origin;
        const Vec2 up((turn * plane.e1).z(), (turn * plane.e2).z());
        if (up.squaredNorm() > 0)
            polygon = clipHalfPlane(polygon, -up, origin.z() - base);
        else if (origin.z() < base)
            return;
    }
    if (!polygon.empty()) addPatch(state.wet, b, water, -1, plane, polygon, head.on(state, b, plane));
}

/// A block face. What of it lies on another part of its block is no wall: the same polygons looking the other
/// way take it off.
void addWall(State& state, std::size_t water, const WetFace& wall, const HeadOverHeight& head) {
    const auto b = static_cast<std::size_t>(wall.block), face = static_cast<std::size_t>(wall.face);
    const Polyhedron& shape = state.geometry->shape[b];
    const FaceFrame plane = faceFrame(shape, face);
    addWetPart(state, water, b, plane, outlineOf(shape, face), head);
    const FaceFrame back{plane.origin, plane.e2, plane.e1, -plane.e3};
    for (const Polygon& cover : coversOf(shape, face)) {
        Polygon seen;
        for (std::size_t v = cover.size(); v-- > 0;) seen.push({cover[v].y(), cover[v].x()});
        addWetPart(state, water, b, back, seen, head);
    }
}

/// The faces of a pair of blocks that meet in the plane of the largest of their interfaces: only blocks of
/// several parts have more than one.
std::vector<std::size_t> interfacesOf(const State& state, const std::pair<std::int32_t, std::int32_t>& pair) {
    constexpr double kSamePlane = 1e-6;  // [rad], and of the length scale
    const Interfaces& f = state.interfaces;
    const std::int32_t largest = largestInterface(state, pair.first, pair.second);
    if (largest < 0) return {};
    const auto first = static_cast<std::size_t>(largest);
    std::vector<std::size_t> found{first};
    const auto block = static_cast<std::size_t>(pair.first);
    if (state.geometry->shape[block].partCount() == 1 &&
        state.geometry->shape[static_cast<std::size_t>(pair.second)].partCount() == 1)
        return found;
    const RelativePose plane = relativePose(state, first);
    const Incidence& incidence = state.incidence;
    for (auto k = incidence.interface_begin[block]; k < incidence.interface_begin[block + 1]; ++k) {
        const auto i = static_cast<std::size_t>(incidence.interface[static_cast<std::size_t>(k)]);
        if (i == first || isVertexEdge(f, i) ||
            std::minmax(f.block_a[i], f.block_b[i]) != std::minmax(pair.first, pair.second))
            continue;
        const RelativePose pose = relativePose(state, i);
        if ((pose.e3 - plane.e3).norm() <= kSamePlane &&
            std::abs(plane.e3.dot(pose.origin - plane.origin)) <= kSamePlane * state.geometry->length_scale)
            found.push_back(i);
    }
    return found;
}

/// Two heads, linear between the ends along x (along z for a patch normal to x) of all interfaces of a pair:
/// value at one's origin and gradient along its e1, e2 [m].
Vec3 headField(const State& state, const std::vector<std::size_t>& all, std::size_t i,
               const std::array<double, 2>& head) {
    const RelativePose pose = relativePose(state, i);
    const int axis = std::abs(pose.e3.x()) > 0.99 ? 2 : 0;
    double low = kInfinity, high = -kInfinity;
    for (const std::size_t one : all) {
        const RelativePose other = relativePose(state, one);
        const double shift = other.origin[axis] - pose.origin[axis];
        for (const Vec2& v : patchOutline(state.interfaces, one)) {
            const double along = shift + v.x() * other.e1[axis] + v.y() * other.e2[axis];
            low = std::min(low, along);
            high = std::max(high, along);
        }
    }
    const double slope = (head[0] - head[1]) / (high - low);
    return {head[1] - slope * low, slope * pose.e1[axis], slope * pose.e2[axis]};
}

/// Both walls of one interface: the same polygon and the same points, so that the two wrenches are opposite
/// to rounding.
void addInterfaceWalls(State& state, std::size_t water, const std::vector<std::size_t>& all, std::size_t i) {
    const Interfaces& f = state.interfaces;
    const RelativePose pose = relativePose(state, i);
    const Water& description = state.geometry->model.waters[water];
    const Vec3 head = description.kind == Water::Level::head ? headField(state, all, i, description.head)
                                                             : Vec3(Vec3::Zero());
    Polygon outward, inward;
    for (const Vec2& v : patchOutline(f, i)) outward.push(v);
    for (std::size_t v = outward.size(); v-- > 0;) inward.push({outward[v].y(), outward[v].x()});
    const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
    const InterfaceFrame frame = f.frame(i);
    const FaceFrame plane_a{frame.origin_a, frame.e1_a, frame.e2_a, {}};
    // b's wall in a's plane, tangents exchanged so that its normal looks back at a.
    const Mat3 turn_b = state.blocks.orientation.matrix(b);
    const FaceFrame plane_b{turn_b.transpose() * (pose.origin - state.blocks.position.get(b)),
                            turn_b.transpose() * pose.e2,
                            turn_b.transpose() * pose.e1,
                            {}};
    addPatch(state.wet, a, water, static_cast<std::int32_t>(i), plane_a, outward, head);
    addPatch(state.wet, b, water, static_cast<std::int32_t>(i), plane_b, inward,
             {head.x(), head.z(), head.y()});
}

void clearWet(State& state) {
    state.wet = {};
    state.wet.vertex_begin.push_back(0);
}

}  // namespace

EndWalls::EndWalls(const Geometry& geometry, const Water& water) : geometry_(geometry) {
    only_moving_ = water.ends_at_free_blocks && std::any_of(water.walls.begin(), water.walls.end(),
                                                            [&](const WetFace& w) { return moves(w.block); });
}

bool EndWalls::moves(std::int32_t block) const {
    return geometry_.model.blocks[static_cast<std::size_t>(block)].motion != Motion::fixed;
}

Polygon wetPolygon(const WetPatches& wet, std::size_t w) {
    Polygon polygon;
    for (auto v = static_cast<std::size_t>(wet.vertex_begin[w]);
         v < static_cast<std::size_t>(wet.vertex_begin[w + 1]); ++v)
        polygon.push({wet.vertex_x[v], wet.vertex_y[v]});
    return polygon;
}

void finishWalls(State& state) {
    state.wet.moments.clear();
    for (std::size_t w = 0; w < state.wet.size(); ++w)
        state.wet.moments.push_back(momentsOf(wetPolygon(state.wet, w)));
    const std::size_t n = state.blocks.size();
    Incidence& incidence = state.incidence;
    incidence.wet_begin.assign(n + 1, 0);
    for (const std::int32_t b : state.wet.block) ++incidence.wet_begin[static_cast<std::size_t>(b) + 1];
    incidence.wet_blocks.clear();
    for (std::size_t b = 0; b < n; ++b) {
        if (incidence.wet_begin[b + 1] > 0) incidence.wet_blocks.push_back(static_cast<std::int32_t>(b));
        incidence.wet_begin[b + 1] += incidence.wet_begin[b];
    }
    incidence.wet.resize(state.wet.size());
    std::vector<std::int64_t> next(incidence.wet_begin.begin(), incidence.wet_begin.end() - 1);
    for (std::size_t w = 0; w < state.wet.size(); ++w)
        incidence.wet[static_cast<std::size_t>(next[static_cast<std::size_t>(state.wet.block[w])]++)] =
            static_cast<std::int32_t>(w);
}

void makeWalls(State& state) {
    clearWet(state);
    const auto& waters = state.geometry->model.waters;
    for (std::size_t water = 0; water < waters.size(); ++water) {
        state.wet.water_begin.push_back(state.wet.size());
        const HeadOverHeight head = headOverHeight(state, waters[water]);
        for (const WetFace& wall : waters[water].walls) addWall(state, water, wall, head);
        if (!waters[water].pair) continue;
        const std::vector<std::size_t> all = interfacesOf(state, *waters[water].pair);
        for (const std::size_t i : all) addInterfaceWalls(state, water, all, i);
    }
    state.wet.water_begin.push_back(state.wet.size());
    state.wet.computed_position.resize(state.wet.size());
    state.wet.computed_orientation.resize(state.wet.size());
    finishWalls(state);
    state.pressure.assign(waters.size(), PressureField{});
    state.water_load.assign(waters.size(), WaterLoad{});
}

std::vector<Error> dryErrors(const State& state) {
    std::vector<Error> errors;
    const Model& model = state.geometry->model;
    for (std::size_t water = 0; water < model.waters.size(); ++water) {
        if (state.wet.water_begin[water] < state.wet.water_begin[water + 1]) continue;
        const Water& description = model.waters[water];
        if (!description.pair) {
            errors.push_back(
                {description.field,
                 "no block face bounds this water; allowed: a joint with a wall above its base"});
            continue;
        }
        errors.push_back({description.field + ".between",
                          "blocks \"" + model.blocks[static_cast<std::size_t>(description.pair->first)].name +
                              "\" and \"" +
                              model.blocks[static_cast<std::size_t>(description.pair->second)].name +
                              "\" share no interface; allowed: two blocks whose faces touch"});
    }
    return errors;
}

}  // namespace talus
