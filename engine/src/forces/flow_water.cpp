#include "forces/flow_water.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flow/flow_in.h"
#include "flow/meshing.h"
#include "geometry/face_frame.h"
#include "geometry/pressure.h"

namespace talus::flow_water {
namespace {

/// Numbers of a part: force [N] and moment about the centroid [N m], in the block's own frame.
constexpr std::size_t kNumbers = 6;
constexpr double kSurface = 1e-9;  // of the median patch: a pressure head nearer to zero is rounding

/// Adds a push along a direction through points whose first moment about `from` is given.
void add(const State& state, std::int32_t block, const Vec3& direction, const TrianglePush& push,
         const Vec3& from, std::vector<Wrench>& sums) {
    const auto b = static_cast<std::size_t>(block);
    const Vec3 centroid = state.geometry->initial_position.get(b);
    const Vec3 first_moment = push.force * (from - centroid) + push.moment;
    sums[b] += {push.force * direction, first_moment.cross(direction)};
}

/// On each block about its centroid, model frame, at the initial poses. Pressure heads keep their sign here:
/// the free surface cuts a triangle where the linear pressure passes zero, not at the next node.
std::vector<Wrench> pushesOf(const State& state, const SteadyFlow& flow) {
    const Model& model = state.geometry->model;
    const double unit_weight = model.flow->density * model.gravity.magnitude;
    std::vector<Wrench> sums(state.blocks.size());
    for (std::size_t t = 0; t < flow.triangles.size(); ++t) {
        if (!flow.isWet(t)) continue;
        std::array<Vec3, 3> corners;
        std::array<double, 3> pressure{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto n = static_cast<std::size_t>(flow.triangles[t][k]);
            corners[k] = flow.nodes[n] - state.geometry->origin;
            pressure[k] = unit_weight * flow.pressure_head[n];
        }
        const TrianglePush push = pushOn(corners, pressure);
        add(state, flow.block_a[t], -flow.normal[t], push, corners[0], sums);
        add(state, flow.block_b[t], flow.normal[t], push, corners[0], sums);
    }
    return sums;
}

/// A part for each block that the flow pushes; of coupled flow, for each that it may push.
void store(const std::vector<double>& pushes, const std::vector<char>& may_push, ForceParts& parts) {
    for (std::size_t b = 0; b < may_push.size(); ++b) {
        const auto first = pushes.begin() + static_cast<std::ptrdiff_t>(kNumbers * b);
        const auto end = first + static_cast<std::ptrdiff_t>(kNumbers);
        if (may_push[b] == 0 && std::all_of(first, end, [](double x) { return x == 0; })) continue;
        parts.block.push_back(static_cast<std::int32_t>(b));
        parts.begin.push_back(parts.source.size());
        parts.source.push_back(0);
        parts.numbers.insert(parts.numbers.end(), first, end);
    }
    parts.begin.push_back(parts.source.size());
}

/// Blocks at the network.
std::vector<char> wetted(const State& state, const SteadyFlow& flow) {
    std::vector<char> wet(state.blocks.size(), 0);
    for (std::size_t t = 0; t < flow.triangles.size(); ++t)
        for (const std::int32_t block : {flow.block_a[t], flow.block_b[t]})
            wet[static_cast<std::size_t>(block)] = 1;
    return wet;
}

bool bounds(const Interfaces& f, std::size_t i, const WetFace& wall) {
    return f.kind[i] == InterfaceKind::faces && ((f.block_a[i] == wall.block && f.face_a[i] == wall.face) ||
                                                 (f.block_b[i] == wall.block && f.face_b[i] == wall.face));
}

bool wetsJoint(const State& state, const Water& water) {
    if (water.pair) return true;
    for (std::size_t i = 0; i < state.interfaces.size(); ++i)
        if (std::any_of(water.walls.begin(), water.walls.end(),
                        [&](const WetFace& wall) { return bounds(state.interfaces, i, wall); }))
            return true;
    return false;
}

}  // namespace

TrianglePush pushOn(const std::array<Vec3, 3>& corners, const std::array<double, 3>& pressure) {
    const Vec3 across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const FaceFrame plane = faceFrame(corners[0], corners[1], across.normalized());
    const Polygon triangle{plane.toPlane(corners[0]), plane.toPlane(corners[1]), plane.toPlane(corners[2])};
    const Vec2 &b = triangle[1], &c = triangle[2];
    LinearPressure linear{pressure[0], Vec2::Zero()};
    linear.gradient.x() = (pressure[1] - pressure[0]) / b.x();
    linear.gradient.y() = (pressure[2] - pressure[0] - linear.gradient.x() * c.x()) / c.y();
    const Thrust thrust = thrustOn(triangle, linear);
    return {thrust.force, thrust.moment_x * plane.e1 + thrust.moment_y * plane.e2};
}

double wetShare(std::array<double, 3> pressure) {
    auto& [least, middle, most] = pressure;
    std::sort(pressure.begin(), pressure.end());
    if (most <= 0) return 0;
    if (least >= 0) return 1;
    // The part on one side of the line p = 0 is a triangle like the whole, cut at these shares of two edges.
    if (middle <= 0) return most / (most - least) * (most / (most - middle));
    return 1 - least / (least - most) * (least / (least - middle));
}

std::vector<double> wetAreas(const State& built) {
    std::vector<double> areas(built.interfaces.size(), 0.0);
    const std::optional<Flow>& flow = built.geometry->model.flow;
    if (!flow) return areas;
    const auto solved = flow::flowIn(built, *flow);
    if (!solved) return areas;  // the build has said why
    const flow::Network network = flow::networkOf(built, flow->refinements, flow->boundaries);
    const double none = kSurface * network.size;
    for (std::size_t t = 0; t < network.triangles.size(); ++t) {
        std::array<double, 3> head{};
        for (std::size_t k = 0; k < 3; ++k) {
            const double at = solved->pressure_head[static_cast<std::size_t>(network.triangles[t][k])];
            head[k] = std::abs(at) > none ? at : 0.0;
        }
        const Vec3& from = network.corner(t, 0);
        const Vec3 across = (network.corner(t, 1) - from).cross(network.corner(t, 2) - from);
        areas[static_cast<std::size_t>(network.patch(t).interface)] += wetShare(head) * 0.5 * across.norm();
    }
    return areas;
}

std::vector<Error> conflicts(const State& state, const Flow& flow) {
    const Model& model = state.geometry->model;
    const std::string allowed = " beside " + flow.field + "; allowed: one of them in a joint";
    std::vector<Error> errors;
    if (model.phreatic) errors.push_back({model.phreatic->field, "found a water table" + allowed});
    for (const Water& water : model.waters)
        if (wetsJoint(state, water)) errors.push_back({water.field, "found water in a joint" + allowed});
    return errors;
}

std::vector<double> ownPushes(const State& state, const SteadyFlow& flow) {
    const std::vector<Wrench> sums = pushesOf(state, flow);
    std::vector<double> pushes;
    pushes.reserve(kNumbers * sums.size());
    for (std::size_t b = 0; b < sums.size(); ++b) {
        const Mat3 back = state.geometry->initial_orientation.matrix(b).transpose();
        const Vec3 force = back * sums[b].force, moment = back * sums[b].torque;
        pushes.insert(pushes.end(), force.begin(), force.end());
        pushes.insert(pushes.end(), moment.begin(), moment.end());
    }
    return pushes;
}

std::vector<Error> build(State& state, ForceParts& parts) {
    const std::optional<Flow>& flow = state.geometry->model.flow;
    if (!flow) return {};
    if (std::vector<Error> errors = conflicts(state, *flow); !errors.empty()) return errors;
    const auto solved = flow::flowIn(state, *flow);
    if (!solved) return solved.errors();
    const std::vector<double> pushes = ownPushes(state, *solved);
    if (!flow->coupled) {
        store(pushes, std::vector<char>(state.blocks.size(), 0), parts);
        return {};
    }
    store(pushes, wetted(state, *solved), parts);
    state.coupled_pressure.pressure_head = solved->pressure_head;
    state.coupled_pressure.push = pushes;
    return {};
}

Wrench on(const State& state, const ForceParts& parts, std::size_t block) {
    const auto found =
        std::lower_bound(parts.block.begin(), parts.block.end(), static_cast<std::int32_t>(block));
    if (found == parts.block.end() || *found != static_cast<std::int32_t>(block)) return {};
    const std::vector<double>& coupled = state.coupled_pressure.push;
    const auto part = static_cast<std::size_t>(found - parts.block.begin());
    const double* n = coupled.empty() ? &parts.numbers[kNumbers * part] : &coupled[kNumbers * block];
    const Mat3 turn = state.load.water_share * state.blocks.orientation.matrix(block);
    return {turn * Vec3(n[0], n[1], n[2]), turn * Vec3(n[3], n[4], n[5])};
}

std::vector<ForceArray> memory(const State& state) {
    if (state.coupled_pressure.push.empty()) return {};
    return {{"push", state.coupled_pressure.push}};
}

void remember(State& state, std::span<const ForceArray> arrays) {
    if (!arrays.empty()) state.coupled_pressure.push = arrays.front().values;
}

}  // namespace talus::flow_water
