#include "forces/water.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "forces/closed_water.h"
#include "forces/contact_forces.h"
#include "forces/water_level.h"
#include "forces/water_table.h"
#include "forces/wet_walls.h"
#include "geometry/pressure.h"
#include "model/gravity.h"
#include "model/over_time.h"
#include "state/incidence.h"

namespace talus {
namespace {

constexpr double kStalePose = 1e-7;   // of the block's radius: a wall that moved less keeps its wrench
constexpr double kSameHeight = 1e-9;  // of the length scale: heights that differ by less differ by rounding
constexpr double kSharedWet = 1e-9;   // of the smaller wet part: more in common is an overlap

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

JointEnds endsOf(const State& state, std::size_t water, const Vec3& down, const EndWalls& walls) {
    JointEnds ends;
    double deepest = -kInfinity, highest = kInfinity;
    for (std::size_t w = state.wet.water_begin[water]; w < state.wet.water_begin[water + 1]; ++w) {
        if (!walls.counts(state.wet.block[w])) continue;
        for (const Vec2& v : wetPolygon(state.wet, w)) {
            const Vec3 x = initialPoint(state, w, v);
            const double depth = down.dot(x);
            if (depth > deepest) deepest = depth, ends.low = x;
            if (depth < highest) highest = depth, ends.high = x;
        }
    }
    return ends;
}
JointEnds endsOf(const State& state, std::size_t water, const Vec3& down) {
    return endsOf(state, water, down, {*state.geometry, state.geometry->model.waters[water]});
}

/// Of E. Hoek and J. W. Bray's distributions, the part that falls towards the lower end.
std::optional<PressureField::Bound> fallingTo(const JointEnds& ends, Water::Daylight daylight,
                                              const PressureField& field, const Vec3& down) {
    const double height = down.dot(ends.low - ends.high);
    if (daylight == Water::Daylight::closed || !(height > 0)) return std::nullopt;
    const double at_top = std::max(0.0, field.p0 + field.gradient.dot(ends.high));
    // Rising from nothing at the lower end: to what it is at the upper one, or as fast as the other half
    // falls.
    const double rate = daylight == Water::Daylight::straight ? at_top / height : field.gradient.dot(down);
    return PressureField::Bound{rate * down.dot(ends.low), -rate * down};
}

/// Most walls are wholly wet or dry; only a wall that the water line crosses needs clipping.
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
    return pressure.most ? pressure.on(wetPolygon(wet, w)) : thrustOnWall(wet, w, pressure.hydrostatic);
}

/// Thrust against the outward normal, and its moment about the centroid: integral of r x (-e3 p) over the wet
/// part.
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

/// What a wall's water wets now.
struct WetPart {
    std::size_t wall = 0;
    Polygon polygon{};  ///< in the wall's plane
    Vec3 low = Vec3::Constant(kInfinity),
         high = Vec3::Constant(-kInfinity);  ///< in the block's own frame [m]
};

/// The wet parts of a block's walls, ascending by their lower ends along an axis.
std::vector<WetPart> wetPartsOf(const State& state, std::size_t block, int& axis) {
    const WetPatches& wet = state.wet;
    std::vector<WetPart> parts;
    Vec3 low = Vec3::Constant(kInfinity), high = Vec3::Constant(-kInfinity);
    for (auto k = state.incidence.wet_begin[block]; k < state.incidence.wet_begin[block + 1]; ++k) {
        const auto w = static_cast<std::size_t>(state.incidence.wet[static_cast<std::size_t>(k)]);
        WetPart part{.wall = w, .polygon = wetPart(wetPolygon(wet, w), pressureOnWall(state, w).hydrostatic)};
        if (part.polygon.empty()) continue;
        for (const Vec2& v : part.polygon) {
            const Vec3 x = wet.origin.get(w) + v.x() * wet.e1.get(w) + v.y() * wet.e2.get(w);
            part.low = part.low.cwiseMin(x), part.high = part.high.cwiseMax(x);
        }
        low = low.cwiseMin(part.low), high = high.cwiseMax(part.high);
        parts.push_back(std::move(part));
    }
    if (!parts.empty()) (high - low).maxCoeff(&axis);
    std::stable_sort(parts.begin(), parts.end(),
                     [&](const WetPart& a, const WetPart& b) { return a.low[axis] < b.low[axis]; });
    return parts;
}

/// The first two walls of a block, in the order of their numbers, whose waters wet the same place. A wet part
/// is compared with those alone that begin before it ends.
std::optional<std::pair<std::size_t, std::size_t>> sharedWet(const State& state, std::size_t block) {
    int axis = 0;
    const std::vector<WetPart> parts = wetPartsOf(state, block, axis);
    std::optional<std::pair<std::size_t, std::size_t>> shared;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t j = i + 1; j < parts.size() && parts[j].low[axis] <= parts[i].high[axis]; ++j) {
            const WetPart &first = parts[i], &second = parts[j];
            if (!samePlace(state.wet, first.wall, second.wall)) continue;
            const Polygon common =
                intersect(first.polygon, inPlaneOf(state, first.wall, second.wall, second.polygon));
            const double smaller = std::min(area(first.polygon), area(second.polygon));
            if (common.empty() || area(common) <= kSharedWet * smaller) continue;
            const std::pair<std::size_t, std::size_t> walls = std::minmax(first.wall, second.wall);
            if (!shared || walls < *shared) shared = walls;
        }
    }
    return shared;
}

std::vector<Error> sharedWetErrors(const State& state) {
    const Model& model = state.geometry->model;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        const auto shared = sharedWet(state, b);
        if (!shared) continue;
        const auto water_of = [&](std::size_t wall) {
            return static_cast<std::size_t>(state.wet.water[wall]);
        };
        const auto [first, second] = std::minmax({water_of(shared->first), water_of(shared->second)});
        return {{model.waters[second].field, "its wet part on block \"" + model.blocks[b].name +
                                                 "\" overlaps that of " + model.waters[first].field +
                                                 "; allowed: waters on parts of a face that do not overlap"}};
    }
    return {};
}

/// The present load, at the time when a water stands highest.
Load atHighestLevel(const State& state, std::size_t water) {
    Load load = state.load;
    const Water& description = state.geometry->model.waters[water];
    for (const LevelPoint& point : description.level)
        if (point.value >= levelAt(description, load.time)) load.time = point.time;
    return load;
}

/// Waters that wet the same part of a face under the present load, each at the highest of its levels over
/// time.
/// \post the pressures are those
std::vector<Error> overlapErrors(State& state) {
    for (std::size_t water = 0; water < state.pressure.size(); ++water)
        state.pressure[water] = pressureField(state, water, atHighestLevel(state, water));
    return sharedWetErrors(state);
}

/// Of a water table: where it stands along gravity. \pre the pressure rises with depth
double heightOfTable(const State& state, const PressureField& field, const Vec3& down) {
    const Vec3 point = -field.p0 / field.gradient.squaredNorm() * field.gradient;
    return -down.dot(point + state.geometry->origin);
}

/// Whether walls look at each other, as the two sides of a joint do.
bool hasTwoSides(const State& state, std::size_t water) {
    std::optional<Vec3> first;
    for (std::size_t w = state.wet.water_begin[water]; w < state.wet.water_begin[water + 1]; ++w) {
        const auto b = static_cast<std::size_t>(state.wet.block[w]);
        const Mat3 turn = state.geometry->initial_orientation.matrix(b);
        const Vec3 normal = turn * state.wet.e1.get(w).cross(state.wet.e2.get(w));
        if (!first) first = normal;
        if (first->dot(normal) < 0) return true;
    }
    return false;
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

PressureField pressureField(const State& state, std::size_t index, const Load& load) {
    const Water& water = state.geometry->model.waters[index];
    if (state.drained[index]) return {};
    const double g = state.geometry->model.gravity.magnitude;
    const double unit_weight = water.density * g * load.water_share;
    const Vec3 down = downward(state.geometry->model.gravity, load.tilt);
    if (water.kind == Water::Level::head) return {unit_weight * -down.z(), Vec3::Zero()};
    const double level = levelNow(state, index, load.time);
    const Vec3 table = water.kind == Water::Level::elevation ? Vec3(-level * down - state.geometry->origin)
                                                             : tablePoint(state, index, level, down);
    // Depth below the table along gravity: down . (x - table).
    PressureField field{-unit_weight * down.dot(table), unit_weight * down};
    if (water.daylight != Water::Daylight::closed)
        field.most = fallingTo(endsOf(state, index, down), water.daylight, field, down);
    return field;
}

std::optional<DryWater> whyDry(const State& state, std::size_t water) {
    Load load = atHighestLevel(state, water);
    load.water_share = 1;
    const PressureField field = pressureField(state, water, load);
    const Gravity& gravity = state.geometry->model.gravity;
    const Vec3 down = downward(gravity, load.tilt);
    const auto height = [&](const Vec3& x) { return -down.dot(x + state.geometry->origin); };
    double lowest = kInfinity;
    for (std::size_t w = state.wet.water_begin[water]; w < state.wet.water_begin[water + 1]; ++w) {
        const auto b = static_cast<std::size_t>(state.wet.block[w]);
        if (state.blocks.motion[b] != Motion::free) continue;
        const double thrust = thrustOnWall(state.wet, w, pressureNow(state, w, field)).force;
        if (thrust > kPresses * state.blocks.mass[b] * gravity.magnitude) return std::nullopt;
        for (const Vec2& v : wetPolygon(state.wet, w))
            lowest = std::min(lowest, height(initialPoint(state, w, v)));
    }
    if (lowest == kInfinity) return DryWater{DryWater::Why::no_free_wall};
    if (field.gradient.isZero()) return DryWater{DryWater::Why::no_head};
    const double table = heightOfTable(state, field, down);
    const double upper_end = height(endsOf(state, water, down).high);
    const double same = kSameHeight * state.geometry->length_scale;
    if (field.most && table <= upper_end + same && table > lowest + same)
        return DryWater{DryWater::Why::falls_from_nothing, table, upper_end};
    return DryWater{DryWater::Why::table_too_low, table, lowest};
}

std::optional<JointHeights> jointHeights(const State& state, std::size_t water) {
    const Water& description = state.geometry->model.waters[water];
    if (description.kind == Water::Level::head || description.density == 0 || state.drained[water] ||
        !hasTwoSides(state, water))
        return std::nullopt;
    const Vec3 down = downward(state.geometry->model.gravity, state.load.tilt);
    Water all = description;
    all.ends_at_free_blocks = false;
    const JointEnds ends = endsOf(state, water, down, {*state.geometry, all});
    const auto height = [&](const Vec3& x) { return -down.dot(x + state.geometry->origin); };
    TableHeight table = tableHeight(state, water, state.load.tilt);
    table.at_zero -= down.dot(state.geometry->origin);
    return JointHeights{table, height(ends.low), height(ends.high)};
}

std::optional<MovedEnds> movedEnds(const State& state, std::size_t water) {
    const Model& model = state.geometry->model;
    const Vec3 down = downward(model.gravity, state.load.tilt);
    const EndWalls ends(*state.geometry, model.waters[water]);
    if (!ends.leavesOut()) return std::nullopt;
    Water all = model.waters[water];
    all.ends_at_free_blocks = false;
    const JointEnds now = endsOf(state, water, down, ends),
                    with_fixed = endsOf(state, water, down, {*state.geometry, all});
    const auto height = [&](const Vec3& x) { return -down.dot(x + state.geometry->origin); };
    return MovedEnds{height(now.low), height(with_fixed.low), height(now.high), height(with_fixed.high)};
}

std::vector<Error> buildWater(State& state) {
    makeWalls(state);
    std::vector<Error> errors = dryErrors(state);
    if (errors.empty()) buildClosedWater(state);
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
    updateClosedWater(state);
    for (std::size_t water = 0; water < state.pressure.size(); ++water) {
        const WaterLoad load{state.load.tilt, state.load.water_share, levelNow(state, water, state.load.time),
                             state.drained[water] != 0};
        const bool changed = !(load == state.water_load[water]);
        if (changed) state.pressure[water] = pressureField(state, water, state.load);
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
