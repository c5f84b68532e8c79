#include "forces/water.h"

#include <algorithm>
#include <cmath>

#include "forces/contact_forces.h"
#include "geometry/face_frame.h"
#include "geometry/parts.h"
#include "geometry/pressure.h"
#include "model/gravity.h"
#include "model/over_time.h"
#include "state/incidence.h"

namespace talus {
namespace {

constexpr double kStalePose = 1e-7;  // of the block's radius: a wall that moved less keeps its wrench
constexpr double kSharedWet = 1e-9;  // of the smaller wet part: more in common is an overlap

/// The polygon of a wet patch in its own plane.
Polygon polygonOf(const WetPatches& wet, std::size_t w) {
    Polygon polygon;
    for (auto v = static_cast<std::size_t>(wet.vertex_begin[w]);
         v < static_cast<std::size_t>(wet.vertex_begin[w + 1]); ++v)
        polygon.push({wet.vertex_x[v], wet.vertex_y[v]});
    return polygon;
}

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

/// Two heads, linear over the height at the start between a joint's upper and lower end: where the lower one daylights with none,
/// E. Hoek and J. W. Bray's distribution below a crack full of water.
struct HeadOverHeight {
    double at_zero = 0, slope = 0;  ///< head at the height 0 of the state's z [m], and its rise with height

    /// On a wall: value at the frame's origin and gradient along its e1, e2.
    Vec3 on(const State& state, std::size_t b, const FaceFrame& plane) const {
        const Mat3 turn = state.geometry->initial_orientation.matrix(b);
        const double z = state.geometry->initial_position.get(b).z() + (turn * plane.origin).z();
        return {at_zero + slope * z, slope * (turn * plane.e1).z(), slope * (turn * plane.e2).z()};
    }
};

/// Of a water's walls; none for what is not told by heads.
HeadOverHeight headOverHeight(const State& state, const Water& water) {
    if (water.kind != Water::Level::head || water.pair) return {};
    double low = kInfinity, high = -kInfinity;
    for (const WetFace& wall : water.walls) {
        const auto b = static_cast<std::size_t>(wall.block);
        const Polyhedron& shape = state.geometry->shape[b];
        const Mat3 turn = state.geometry->initial_orientation.matrix(b);
        for (const auto v : shape.faces[static_cast<std::size_t>(wall.face)]) {
            const double z = state.geometry->initial_position.get(b).z() +
                             (turn * shape.vertices[static_cast<std::size_t>(v)]).z();
            low = std::min(low, z);
            high = std::max(high, z);
        }
    }
    const double slope = high > low ? (water.head[0] - water.head[1]) / (high - low) : 0.0;
    return {water.head[1] - slope * low, slope};
}

/// A polygon on a block, less what lies below the water's base at the start.
void addAbove(State& state, std::size_t water, std::size_t b, const FaceFrame& plane, Polygon polygon,
              const HeadOverHeight& head) {
    const double base = state.geometry->model.waters[water].base - state.geometry->origin.z();
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

/// A block face. What of it lies on another part of its block is no wall: the same polygons looking the other way take it off.
void addWall(State& state, std::size_t water, const WetFace& wall, const HeadOverHeight& head) {
    const auto b = static_cast<std::size_t>(wall.block), face = static_cast<std::size_t>(wall.face);
    const Polyhedron& shape = state.geometry->shape[b];
    const FaceFrame plane = faceFrame(shape, face);
    addAbove(state, water, b, plane, outlineOf(shape, face), head);
    const FaceFrame back{plane.origin, plane.e2, plane.e1, -plane.e3};
    for (const Polygon& cover : coversOf(shape, face)) {
        Polygon seen;
        for (std::size_t v = cover.size(); v-- > 0;) seen.push({cover[v].y(), cover[v].x()});
        addAbove(state, water, b, back, seen, head);
    }
}

/// The faces of a pair of blocks that meet in the plane of the largest of their interfaces: only blocks of several parts have
/// more than one.
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

/// Two heads, linear between the ends along x (along z for a patch normal to x) of all interfaces of a pair: value at one's
/// origin and gradient along its e1, e2 [m].
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

/// Both walls of one interface: the same polygon and the same points, so that the two wrenches are opposite to
/// rounding.
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

}  // namespace

void finishWalls(State& state) {
    state.wet.moments.clear();
    for (std::size_t w = 0; w < state.wet.size(); ++w)
        state.wet.moments.push_back(momentsOf(polygonOf(state.wet, w)));
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

namespace {

Vec3 initialPoint(const State& state, std::size_t w, const Vec2& v) {
    const auto b = static_cast<std::size_t>(state.wet.block[w]);
    const Vec3 own = state.wet.origin.get(w) + v.x() * state.wet.e1.get(w) + v.y() * state.wet.e2.get(w);
    return state.geometry->initial_position.get(b) + state.geometry->initial_orientation.matrix(b) * own;
}

/// A point of the water table whose level is a depth up the joint plane's steepest line from its lowest wet point, as
/// the joint lay at the start.
Vec3 tablePoint(const State& state, std::size_t water, double depth, const Vec3& down) {
    Vec3 lowest = Vec3::Zero(), normal = Vec3::Zero();
    double deepest = -kInfinity;
    for (std::size_t w = state.wet.water_begin[water]; w < state.wet.water_begin[water + 1]; ++w)
        for (const Vec2& v : polygonOf(state.wet, w)) {
            const Vec3 x = initialPoint(state, w, v);
            if (down.dot(x) <= deepest) continue;
            deepest = down.dot(x);
            lowest = x;
            const Mat3 turn =
                state.geometry->initial_orientation.matrix(static_cast<std::size_t>(state.wet.block[w]));
            normal = turn * state.wet.e1.get(w).cross(state.wet.e2.get(w));
        }
    const Vec3 steepest = -down + down.dot(normal) * normal;
    const Vec3 up = steepest.norm() > 1e-9 ? Vec3(steepest.normalized()) : Vec3(-down);
    return lowest + depth * up;
}

LinearPressure pressureOnPatch(const State& state, std::size_t w, const PressureField& field,
                               const Mat3& turn, const Vec3& position) {
    const WetPatches& wet = state.wet;
    const Water& water = state.geometry->model.waters[static_cast<std::size_t>(wet.water[w])];
    if (water.kind == Water::Level::head)
        return {field.p0 * wet.head.x[w], field.p0 * Vec2(wet.head.y[w], wet.head.z[w])};
    const Vec3 gradient = turn.transpose() * field.gradient;  // in the block's own frame
    return {field.p0 + field.gradient.dot(position) + gradient.dot(wet.origin.get(w)),
            {gradient.dot(wet.e1.get(w)), gradient.dot(wet.e2.get(w))}};
}

WallPressure pressureNow(const State& state, std::size_t w, const PressureField& field) {
    const auto b = static_cast<std::size_t>(state.wet.block[w]);
    const Mat3 turn = state.blocks.orientation.matrix(b);
    const Vec3 position = state.blocks.position.get(b);
    WallPressure pressure{pressureOnPatch(state, w, field, turn, position)};
    if (field.most)
        pressure.most = pressureOnPatch(state, w, {field.most->p0, field.most->gradient}, turn, position);
    return pressure;
}

/// The ends of a joint along gravity, as it lay at the start.
struct JointEnds {
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();
};

JointEnds endsOf(const State& state, std::size_t water, const Vec3& down) {
    JointEnds ends;
    double deepest = -kInfinity, highest = kInfinity;
    for (std::size_t w = state.wet.water_begin[water]; w < state.wet.water_begin[water + 1]; ++w)
        for (const Vec2& v : polygonOf(state.wet, w)) {
            const Vec3 x = initialPoint(state, w, v);
            const double depth = down.dot(x);
            if (depth > deepest) deepest = depth, ends.low = x;
            if (depth < highest) highest = depth, ends.high = x;
        }
    return ends;
}

/// Of E. Hoek and J. W. Bray's distributions, the part that falls towards the lower end.
std::optional<PressureField::Bound> fallingTo(const JointEnds& ends, Water::Daylight daylight,
                                              const PressureField& field, const Vec3& down) {
    const double height = down.dot(ends.low - ends.high);
    if (daylight == Water::Daylight::closed || !(height > 0)) return std::nullopt;
    const double at_top = std::max(0.0, field.p0 + field.gradient.dot(ends.high));
    // Rising from nothing at the lower end: to what it is at the upper one, or as fast as the other half falls.
    const double rate = daylight == Water::Daylight::straight ? at_top / height : field.gradient.dot(down);
    return PressureField::Bound{rate * down.dot(ends.low), -rate * down};
}

/// Most walls are under water or dry all over; only one that the water line crosses has to be gone round.
Thrust thrustOnWall(const WetPatches& wet, std::size_t w, const LinearPressure& pressure) {
    const auto first = static_cast<std::size_t>(wet.vertex_begin[w]);
    const auto corners = static_cast<std::size_t>(wet.vertex_begin[w + 1]) - first;
    const auto corner = [&](std::size_t k) { return Vec2(wet.vertex_x[first + k], wet.vertex_y[first + k]); };
    const PressureRange range = pressureOver(corners, corner, pressure);
    if (range.most <= 0) return {};
    if (range.least >= 0) return thrustOnWhole(wet.moments[w], pressure);
    return thrustOn(corners, corner, pressure);
}

Thrust thrustOnWall(const WetPatches& wet, std::size_t w, const WallPressure& pressure) {
    return pressure.most ? pressure.on(polygonOf(wet, w)) : thrustOnWall(wet, w, pressure.hydrostatic);
}

/// Thrust against the outward normal, and its moment about the centroid: integral of r x (-e3 p) over the wet part.
void computeWrench(State& state, std::size_t w, const PressureField& field) {
    WetPatches& wet = state.wet;
    const Thrust thrust = thrustOnWall(wet, w, pressureNow(state, w, field));
    const Vec3 e1 = wet.e1.get(w), e2 = wet.e2.get(w), e3 = e1.cross(e2);
    const Vec3 first_moment = thrust.force * wet.origin.get(w) + thrust.moment_x * e1 + thrust.moment_y * e2;
    wet.force.set(w, -thrust.force * e3);
    wet.moment.set(w, -first_moment.cross(e3));
    const auto b = static_cast<std::size_t>(wet.block[w]);
    wet.computed_position.set(w, state.blocks.position.get(b));
    wet.computed_orientation[w] = state.blocks.orientation[b];
}

bool poseIsStale(const State& state, std::size_t w) {
    const auto b = static_cast<std::size_t>(state.wet.block[w]);
    const double radius = state.geometry->radius[b], limit = kStalePose * radius;
    const Vec3 shift = state.blocks.position.get(b) - state.wet.computed_position.get(w);
    if (shift.squaredNorm() > limit * limit) return true;
    const Quaternion &q = state.wet.computed_orientation[w], &o = state.blocks.orientation[b];
    const double dw = q.w - o.w, dx = q.x - o.x, dy = q.y - o.y, dz = q.z - o.z;
    return 4.0 * (dw * dw + dx * dx + dy * dy + dz * dz) > kStalePose * kStalePose;
}

bool samePlace(const WetPatches& wet, std::size_t i, std::size_t j) {
    if (wet.block[i] != wet.block[j] || wet.water[i] == wet.water[j]) return false;
    const Vec3 n_i = wet.e1.get(i).cross(wet.e2.get(i)), n_j = wet.e1.get(j).cross(wet.e2.get(j));
    return n_i.dot(n_j) > 0.999;
}

/// The wet part of patch j in the plane of patch i, both on the same face.
Polygon inPlaneOf(const State& state, std::size_t i, std::size_t j, const Polygon& wet_j) {
    const WetPatches& wet = state.wet;
    Polygon result;
    for (const Vec2& v : wet_j) {
        const Vec3 d = wet.origin.get(j) + v.x() * wet.e1.get(j) + v.y() * wet.e2.get(j) - wet.origin.get(i);
        result.push({d.dot(wet.e1.get(i)), d.dot(wet.e2.get(i))});
    }
    return result;
}

std::vector<Error> sharedWetErrors(const State& state) {
    const Model& model = state.geometry->model;
    const auto wetPartOf = [&](std::size_t w) {
        return wetPart(polygonOf(state.wet, w), pressureOnWall(state, w).hydrostatic);
    };
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        for (auto k = state.incidence.wet_begin[b]; k < state.incidence.wet_begin[b + 1]; ++k)
            for (auto l = k + 1; l < state.incidence.wet_begin[b + 1]; ++l) {
                const auto i = static_cast<std::size_t>(state.incidence.wet[static_cast<std::size_t>(k)]);
                const auto j = static_cast<std::size_t>(state.incidence.wet[static_cast<std::size_t>(l)]);
                if (!samePlace(state.wet, i, j)) continue;
                const Polygon wet_i = wetPartOf(i), wet_j = wetPartOf(j);
                if (wet_i.empty() || wet_j.empty()) continue;
                const Polygon common = intersect(wet_i, inPlaneOf(state, i, j, wet_j));
                if (common.empty() || area(common) <= kSharedWet * std::min(area(wet_i), area(wet_j)))
                    continue;
                const auto first = static_cast<std::size_t>(std::min(state.wet.water[i], state.wet.water[j]));
                const auto second =
                    static_cast<std::size_t>(std::max(state.wet.water[i], state.wet.water[j]));
                return {{model.waters[second].field,
                         "its wet part on block \"" + model.blocks[b].name + "\" overlaps that of " +
                             model.waters[first].field +
                             "; allowed: waters on parts of a face that do not overlap"}};
            }
    return {};
}

/// Waters that wet the same part of a face under the present load, each at the highest of its levels over time.
/// \post the pressures are those
std::vector<Error> overlapErrors(State& state) {
    for (std::size_t water = 0; water < state.pressure.size(); ++water) {
        const Load load = state.load;
        for (const LevelPoint& point : state.geometry->model.waters[water].level)
            if (point.value >= levelAt(state.geometry->model.waters[water], state.load.time))
                state.load.time = point.time;
        state.pressure[water] = pressureField(state, water);
        state.load = load;
    }
    return sharedWetErrors(state);
}

void clearWet(State& state) {
    state.wet = {};
    state.wet.vertex_begin.push_back(0);
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
        const auto index = static_cast<std::int32_t>(water);
        if (std::find(state.wet.water.begin(), state.wet.water.end(), index) != state.wet.water.end())
            continue;
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

/// Whether an interface is bounded by a wall of this water.
bool bounds(const State& state, std::size_t water, std::size_t i) {
    const Water& description = state.geometry->model.waters[water];
    const Interfaces& f = state.interfaces;
    if (description.pair)
        return std::minmax(f.block_a[i], f.block_b[i]) ==
               std::minmax(description.pair->first, description.pair->second);
    for (const WetFace& wall : description.walls)
        if ((f.block_a[i] == wall.block && f.face_a[i] == wall.face) ||
            (f.block_b[i] == wall.block && f.face_b[i] == wall.face))
            return true;
    return false;
}

}  // namespace

Polygon wetPolygon(const State& state, std::size_t w) { return polygonOf(state.wet, w); }

double WallPressure::at(const Vec2& point) const {
    return most ? std::min(hydrostatic.at(point), most->at(point)) : hydrostatic.at(point);
}

Thrust WallPressure::on(const Polygon& polygon) const {
    if (!most) return thrustOn(polygon, hydrostatic);
    const LinearPressure above{hydrostatic.at_origin - most->at_origin,
                               hydrostatic.gradient - most->gradient};
    const LinearPressure below{-above.at_origin, -above.gradient};
    Thrust sum = thrustOn(wetPart(polygon, below), hydrostatic);
    const Thrust falling = thrustOn(wetPart(polygon, above), *most);
    sum.force += falling.force;
    sum.moment_x += falling.moment_x;
    sum.moment_y += falling.moment_y;
    return sum;
}

void boundPressures(State& state) {
    const Model& model = state.geometry->model;
    for (std::size_t water = 0; water < model.waters.size(); ++water) {
        if (model.waters[water].daylight == Water::Daylight::closed) continue;
        const Vec3 down = downward(model.gravity, state.water_load[water].tilt);
        state.pressure[water].most =
            fallingTo(endsOf(state, water, down), model.waters[water].daylight, state.pressure[water], down);
    }
}

WallPressure pressureOnWall(const State& state, std::size_t w) {
    return pressureNow(state, w, state.pressure[static_cast<std::size_t>(state.wet.water[w])]);
}

PressureField pressureField(const State& state, std::size_t index) {
    const Water& water = state.geometry->model.waters[index];
    if (state.drained[index]) return {};
    const double g = state.geometry->model.gravity.magnitude;
    const double unit_weight = water.density * g * state.load.water_share;
    const Vec3 down = downward(state.geometry->model.gravity, state.load.tilt);
    if (water.kind == Water::Level::head) return {unit_weight * -down.z(), Vec3::Zero()};
    const double level = levelAt(water, state.load.time);
    const Vec3 table = water.kind == Water::Level::elevation ? Vec3(-level * down - state.geometry->origin)
                                                             : tablePoint(state, index, level, down);
    // Depth below the table along gravity: down . (x - table).
    PressureField field{-unit_weight * down.dot(table), unit_weight * down};
    if (water.daylight != Water::Daylight::closed)
        field.most = fallingTo(endsOf(state, index, down), water.daylight, field, down);
    return field;
}

std::vector<Error> buildWater(State& state) {
    makeWalls(state);
    std::vector<Error> errors = dryErrors(state);
    const double tilt = state.load.tilt;
    if (const auto start = state.geometry->model.analysis.start; errors.empty() && start && *start != tilt) {
        state.load.tilt = *start;
        errors = overlapErrors(state);
        state.load.tilt = tilt;
    }
    if (errors.empty()) errors = overlapErrors(state);
    state.water_load.assign(state.water_load.size(), WaterLoad{});
    return errors;
}

void rebuildPairWater(State& state) {
    const auto& waters = state.geometry->model.waters;
    if (std::any_of(waters.begin(), waters.end(), [](const Water& water) { return water.pair.has_value(); }))
        makeWalls(state);
}

void updateWater(State& state) {
    if (state.wet.size() == 0) return;
    for (std::size_t water = 0; water < state.pressure.size(); ++water) {
        const WaterLoad load{state.load.tilt, state.load.water_share,
                             levelAt(state.geometry->model.waters[water], state.load.time),
                             state.drained[water] != 0};
        const bool changed = !(load == state.water_load[water]);
        if (changed) state.pressure[water] = pressureField(state, water);
        state.water_load[water] = load;
        const PressureField field = state.pressure[water];
        for (std::size_t w = state.wet.water_begin[water]; w < state.wet.water_begin[water + 1]; ++w)
            if (changed || poseIsStale(state, w)) computeWrench(state, w, field);
    }
}

std::span<const std::int32_t> wetBlocks(const State& state) { return state.incidence.wet_blocks; }

Wrench waterOn(const State& state, std::size_t block) {
    const Incidence& incidence = state.incidence;
    if (incidence.wet_begin[block] == incidence.wet_begin[block + 1]) return {};
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  // in the block's own frame
    for (auto k = incidence.wet_begin[block]; k < incidence.wet_begin[block + 1]; ++k) {
        const auto w = static_cast<std::size_t>(incidence.wet[static_cast<std::size_t>(k)]);
        force += state.wet.force.get(w);
        moment += state.wet.moment.get(w);
    }
    const Mat3 turn = state.blocks.orientation.matrix(block);
    return {turn * force, turn * moment};
}

void drainWater(State& state) {
    const auto& waters = state.geometry->model.waters;
    for (std::size_t water = 0; water < waters.size(); ++water) {
        if (state.drained[water] || waters[water].drains_at_aperture == kInfinity) continue;
        for (std::size_t i = 0; i < state.interfaces.size(); ++i)
            if (bounds(state, water, i) && relativePose(state, i).gap.x() > waters[water].drains_at_aperture)
                state.drained[water] = 1;
    }
}

}  // namespace talus
