#include "forces/water_table.h"

#include "forces/wet_walls.h"
#include "model/gravity.h"

namespace talus {

Vec3 initialPoint(const State& state, std::size_t w, const Vec2& v) {
    const auto b = static_cast<std::size_t>(state.wet.block[w]);
    const Vec3 own = state.wet.origin.get(w) + v.x() * state.wet.e1.get(w) + v.y() * state.wet.e2.get(w);
    return state.geometry->initial_position.get(b) + state.geometry->initial_orientation.matrix(b) * own;
}

namespace {

/// What depths count from: a joint plane's lowest wet point, and up along its steepest line.
struct Foot {
    Vec3 lowest = Vec3::Zero(), up = Vec3::UnitZ();

    Vec3 at(double depth) const { return lowest + depth * up; }
};

Foot footOf(const State& state, std::size_t water, const Vec3& down) {
    Vec3 lowest = Vec3::Zero(), normal = Vec3::Zero();
    double deepest = -kInfinity;
    const EndWalls ends(*state.geometry, state.geometry->model.waters[water]);
    for (std::size_t w = state.wet.water_begin[water]; w < state.wet.water_begin[water + 1]; ++w) {
        if (!ends.counts(state.wet.block[w])) continue;
        for (const Vec2& v : wetPolygon(state.wet, w)) {
            const Vec3 x = initialPoint(state, w, v);
            if (down.dot(x) <= deepest) continue;
            deepest = down.dot(x);
            lowest = x;
            const Mat3 turn =
                state.geometry->initial_orientation.matrix(static_cast<std::size_t>(state.wet.block[w]));
            normal = turn * state.wet.e1.get(w).cross(state.wet.e2.get(w));
        }
    }
    const Vec3 steepest = -down + down.dot(normal) * normal;
    const Vec3 up = steepest.norm() > 1e-9 ? Vec3(steepest.normalized()) : Vec3(-down);
    return {lowest, up};
}

}  // namespace

Vec3 tablePoint(const State& state, std::size_t water, double depth, const Vec3& down) {
    return footOf(state, water, down).at(depth);
}

TableHeight tableHeight(const State& state, std::size_t water, double tilt) {
    const Vec3 down = downward(state.geometry->model.gravity, tilt);
    if (state.geometry->model.waters[water].kind == Water::Level::elevation)
        return {down.dot(state.geometry->origin), 1};
    const Foot foot = footOf(state, water, down);
    return {-down.dot(foot.lowest), -down.dot(foot.up)};
}

}  // namespace talus
