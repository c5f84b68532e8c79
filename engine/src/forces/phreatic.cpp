#include "forces/phreatic.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "forces/contact_forces.h"
#include "forces/water.h"
#include "geometry/box_clip.h"
#include "geometry/parts.h"
#include "model/gravity.h"

namespace talus::phreatic {
namespace {

std::vector<Strip> stripsNow(const State& state) {
    const Model& model = state.geometry->model;
    const PhreaticSurface& surface = *model.phreatic;
    const double unit_weight =
        surface.factor * surface.density * model.gravity.magnitude * state.load.water_share;
    return stripsOf(surface, downward(model.gravity, state.load.tilt), unit_weight, state.geometry->origin);
}

/// Across gravity and y: along it the line's points have to follow each other.
Vec3 acrossOf(const Vec3& down) { return down.cross(Vec3::UnitY()).normalized(); }

Vec3 placeOf(const PhreaticSurface::Point& point, const Vec3& origin) {
    return Vec3(point.x, 0, point.z) - origin;
}

/// Between two points, or level beyond one of them.
Strip stripThrough(const Vec3& point, const Vec3& along, const Vec3& down, const Vec3& across,
                   double unit_weight) {
    const Vec3 normal = along.cross(Vec3::UnitY());  // of the surface
    Strip strip{.across = across};
    strip.gradient = unit_weight / normal.dot(down) * normal;
    strip.p0 = -strip.gradient.dot(point);
    return strip;
}

Thrust thrustOn(const Strip& strip, Polygon polygon, const FaceFrame& face) {
    const double at = strip.across.dot(face.origin);
    const Vec2 across(strip.across.dot(face.e1), strip.across.dot(face.e2));
    for (const double sign : {1.0, -1.0}) {
        const double most = sign > 0 ? strip.high - at : at - strip.low;
        if (polygon.empty()) return {};
        if (most == kInfinity) continue;
        if (across.norm() > 1e-12)
            polygon = clipHalfPlane(polygon, sign * across, most);
        else if (most < 0 || (most == 0 && sign > 0))  // a face along the strip's side belongs to one of two
            return {};
    }
    return talus::thrustOn(polygon, {strip.p0 + strip.gradient.dot(face.origin),
                                     {strip.gradient.dot(face.e1), strip.gradient.dot(face.e2)}});
}

/// On a polygon whose frame is told about a block's centroid: `arm` to the frame's origin, model frame.
Wrench pressureOn(const std::vector<Strip>& strips, const Polygon& outline, const FaceFrame& face,
                  const Vec3& arm) {
    Thrust sum;
    for (const Strip& strip : strips) {
        const Thrust thrust = thrustOn(strip, outline, face);
        sum.force += thrust.force;
        sum.moment_x += thrust.moment_x;
        sum.moment_y += thrust.moment_y;
    }
    const Vec3 first_moment = sum.force * arm + sum.moment_x * face.e1 + sum.moment_y * face.e2;
    return {-sum.force * face.e3, -first_moment.cross(face.e3)};
}

FaceFrame turned(const FaceFrame& own, const Vec3& position, const Vec3& arm, const Mat3& turn) {
    return {position + arm, turn * own.e1, turn * own.e2, turn * own.e3};
}

/// First wall of a block; nothing when it has none.
std::optional<std::size_t> firstWall(const PhreaticWalls& walls, std::int32_t block) {
    const auto first = std::lower_bound(walls.block.begin(), walls.block.end(), block);
    if (first == walls.block.end() || *first != block) return std::nullopt;
    return static_cast<std::size_t>(first - walls.block.begin());
}

/// The face of a block that a plane in the block's own frame lies in, whichever way it looks.
std::size_t faceIn(const Polyhedron& shape, const FaceFrame& plane) {
    std::size_t best = 0;
    double nearest = kInfinity;
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
        const FaceFrame own = faceFrame(shape, f);
        const double off = own.e3.cross(plane.e3).norm() + std::abs(own.e3.dot(plane.origin - own.origin));
        if (off < nearest) nearest = off, best = f;
    }
    return best;
}

/// What another water has wetted feels that water's pressure alone: the surface's is taken off again there.
void leaveToOthers(const std::vector<Strip>& strips, State& state) {
    PhreaticWalls& walls = state.phreatic;
    for (std::size_t w = 0; w < state.wet.size(); ++w) {
        const auto first = firstWall(walls, state.wet.block[w]);
        if (!first) continue;
        const auto b = static_cast<std::size_t>(state.wet.block[w]);
        const Vec3 e1 = state.wet.e1.get(w), e2 = state.wet.e2.get(w);
        const FaceFrame own{state.wet.origin.get(w), e1, e2, e1.cross(e2)};
        const std::size_t wall = *first + faceIn(state.geometry->shape[b], own);
        if (walls.drained[wall] != 0) continue;
        const Mat3 turn = state.blocks.orientation.matrix(b);
        const Vec3 arm = turn * own.origin;
        const Wrench less = pressureOn(strips, wetPolygon(state, w),
                                       turned(own, state.blocks.position.get(b), arm, turn), arm);
        walls.force[wall] -= less.force;
        walls.moment[wall] -= less.torque;
    }
}

}  // namespace

std::vector<Strip> stripsOf(const PhreaticSurface& surface, const Vec3& down, double unit_weight,
                            const Vec3& origin) {
    const Vec3 across = acrossOf(down);
    std::vector<Strip> strips;
    const std::vector<PhreaticSurface::Point>& line = surface.line;
    const auto add = [&](const Vec3& point, const Vec3& along) {
        strips.push_back(stripThrough(point, along, down, across, unit_weight));
    };
    add(placeOf(line.front(), origin), Vec3::UnitX());
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        const Vec3 from = placeOf(line[k], origin), to = placeOf(line[k + 1], origin);
        strips.back().high = across.dot(from);
        add(from, to - from);
        strips.back().low = across.dot(from);
    }
    const double last = across.dot(placeOf(line.back(), origin));
    strips.back().high = last;
    add(placeOf(line.back(), origin), Vec3::UnitX());
    strips.back().low = last;
    return strips;
}

Wrench pressureOn(const std::vector<Strip>& strips, const Polyhedron& shape, std::size_t f,
                  const Vec3& position, const Mat3& turn) {
    const FaceFrame own = faceFrame(shape, f);
    const Vec3 arm = turn * own.origin;
    return pressureOn(strips, outlineOf(shape, f), turned(own, position, arm, turn), arm);
}

std::vector<Error> build(State& state, ForceParts& parts) {
    state.phreatic = {};
    const std::optional<PhreaticSurface>& surface = state.geometry->model.phreatic;
    if (!surface) return {};
    const Vec3 across = acrossOf(downward(state.geometry->model.gravity, state.load.tilt));
    for (std::size_t k = 0; k + 1 < surface->line.size(); ++k)
        if (across.dot(placeOf(surface->line[k + 1], placeOf(surface->line[k], Vec3::Zero()))) <= 0)
            return {{surface->field + ".surface",
                     "seen along gravity the line folds back behind its point " + std::to_string(k + 1) +
                         "; allowed: points that follow each other across gravity"}};
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        parts.block.push_back(static_cast<std::int32_t>(b));
        parts.begin.push_back(state.phreatic.size());
        for (std::size_t f = 0; f < state.geometry->shape[b].faces.size(); ++f) {
            state.phreatic.block.push_back(static_cast<std::int32_t>(b));
            state.phreatic.face.push_back(static_cast<std::int32_t>(f));
        }
    }
    parts.begin.push_back(state.phreatic.size());
    state.phreatic.drained.assign(state.phreatic.size(), 0);
    state.phreatic.force.assign(state.phreatic.size(), Vec3::Zero());
    state.phreatic.moment.assign(state.phreatic.size(), Vec3::Zero());
    return {};
}

void update(State& state) {
    PhreaticWalls& walls = state.phreatic;
    if (walls.size() == 0) return;
    const std::vector<Strip> strips = stripsNow(state);
    for (std::size_t w = 0; w < walls.size(); ++w) {
        Wrench wrench;
        const auto b = static_cast<std::size_t>(walls.block[w]);
        if (walls.drained[w] == 0)
            wrench = pressureOn(strips, state.geometry->shape[b], static_cast<std::size_t>(walls.face[w]),
                                state.blocks.position.get(b), state.blocks.orientation.matrix(b));
        walls.force[w] = wrench.force;
        walls.moment[w] = wrench.torque;
    }
    leaveToOthers(strips, state);
}

void drain(State& state) {
    const Model& model = state.geometry->model;
    if (!model.phreatic || model.phreatic->drains_at_aperture == kInfinity) return;
    const Interfaces& f = state.interfaces;
    const auto dry = [&](std::int32_t block, std::int32_t face) {
        if (const auto first = firstWall(state.phreatic, block))
            state.phreatic.drained[*first + static_cast<std::size_t>(face)] = 1;
    };
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (f.kind[i] != InterfaceKind::faces ||
            relativePose(state, i).gap.x() <= model.phreatic->drains_at_aperture)
            continue;
        dry(f.block_a[i], f.face_a[i]);
        dry(f.block_b[i], f.face_b[i]);
    }
}

Wrench on(const State& state, const ForceParts& parts, std::size_t block) {
    const auto at =
        std::lower_bound(parts.block.begin(), parts.block.end(), static_cast<std::int32_t>(block));
    Wrench sum;
    if (at == parts.block.end() || static_cast<std::size_t>(*at) != block) return sum;
    const auto row = static_cast<std::size_t>(at - parts.block.begin());
    for (std::size_t w = parts.begin[row]; w < parts.begin[row + 1]; ++w)
        sum += Wrench{state.phreatic.force[w], state.phreatic.moment[w]};
    return sum;
}

std::vector<ForceArray> memory(const State& state) {
    const std::vector<std::uint8_t>& drained = state.phreatic.drained;
    if (drained.empty()) return {};
    return {{"drained", {drained.begin(), drained.end()}}};
}

void remember(State& state, std::span<const ForceArray> arrays) {
    for (const ForceArray& array : arrays)
        std::transform(array.values.begin(), array.values.end(), state.phreatic.drained.begin(),
                       [](double value) { return static_cast<std::uint8_t>(value != 0); });
}

}  // namespace talus::phreatic
