#include "limit_analysis/assemble.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "contacts/limits.h"
#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "limit_analysis/section.h"
#include "model/gravity.h"
#include "state/incidence.h"
#include "state/point_layout.h"

namespace talus::limit {
namespace {

/// For each block whether it is left out.
std::vector<bool> absent(const State& state, const std::vector<std::string>& left_out) {
    const std::set<std::string> names(left_out.begin(), left_out.end());
    std::vector<bool> result;
    for (const Block& block : state.geometry->model.blocks) result.push_back(names.count(block.name) > 0);
    return result;
}

void makeBodies(const State& state, const std::vector<bool>& absent, Assembly& assembly) {
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        const bool free = state.blocks.motion[b] == Motion::free && !absent[b];
        assembly.body_of_block.push_back(absent[b] ? kAbsent
                                         : free    ? static_cast<std::int32_t>(assembly.bodies.size())
                                                   : kFixed);
        if (!free) continue;
        Body body;
        body.weight = state.blocks.mass[b] * state.geometry->model.gravity.magnitude;
        body.centroid = state.blocks.position.get(b);
        body.radius = state.geometry->radius[b];
        assembly.bodies.push_back(body);
    }
}

/// Calls with each free block and its body.
template <class Body>
void forFreeBlocks(const Assembly& assembly, const Body& body) {
    for (std::size_t b = 0; b < assembly.body_of_block.size(); ++b)
        if (assembly.body_of_block[b] >= 0) body(b, static_cast<std::size_t>(assembly.body_of_block[b]));
}

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    const Eigen::Vector2d u = b - a, v = c - a;
    return u.x() * v.y() - u.y() * v.x();
}

/// The outermost of some points: corners of their hull, counter-clockwise (Andrew 1979).
std::vector<contact::PatchPoint> outermost(std::vector<contact::PatchPoint> points) {
    if (points.size() < 3) return points;
    std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
        return std::pair(a.position.x(), a.position.y()) < std::pair(b.position.x(), b.position.y());
    });
    const double extent = (points.back().position - points.front().position).norm();
    const double flat = 1e-12 * extent * extent;
    std::vector<contact::PatchPoint> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t first = hull.size();
        for (const contact::PatchPoint& point : points) {
            while (hull.size() >= first + 2 &&
                   turn(hull[hull.size() - 2].position, hull.back().position, point.position) <= flat)
                hull.pop_back();
            hull.push_back(point);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

/// Tangents: the first lies in the vertical plane of x, in which slopes fail, or else along y.
Mat3 tangentFrame(const Vec3& normal) {
    Vec3 first = Vec3::UnitY().cross(normal);
    if (first.norm() < 1e-6) first = Vec3::UnitZ().cross(normal);
    Mat3 axes;
    axes.col(0) = first.normalized();
    axes.col(1) = normal.cross(axes.col(0));
    axes.col(2) = normal;
    return axes;
}

void addPoints(const State& state, std::size_t i, Assembly& assembly) {
    const Interfaces& f = state.interfaces;
    const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
    const std::int32_t body_a = assembly.body_of_block[a], body_b = assembly.body_of_block[b];
    if (body_a == body_b || std::min(body_a, body_b) == kAbsent || isIdle(f, i)) return;
    const double closed = kClosedGap * std::min(state.geometry->size[a], state.geometry->size[b]);
    const RelativePose pose = relativePose(state, i);
    std::vector<contact::PatchPoint> points;
    for (const contact::PatchPoint& point : interfacePoints(f, i, state.geometry->model.points))
        if (pose.gap.x() + point.position.x() * pose.gap.y() + point.position.y() * pose.gap.z() <= closed)
            points.push_back(point);
    if (!contact::holdsUnloaded(state.laws[static_cast<std::size_t>(f.joint[i])]))
        points = outermost(std::move(points));
    for (const contact::PatchPoint& point : points)
        assembly.points.push_back({body_a, body_b,
                                   pose.origin + point.position.x() * pose.e1 + point.position.y() * pose.e2,
                                   tangentFrame(pose.e3), point.area, f.joint[i]});
}

Loads presentForces(const State& state, const Assembly& assembly) {
    Loads loads(assembly.bodies.size());
    forFreeBlocks(assembly, [&](std::size_t b, std::size_t body) {
        const Wrench applied = outsideForcesOn(state, b);
        const Vec3 arm = state.blocks.position.get(b) - assembly.bodies[body].centroid;
        loads[body].force += applied.force;
        loads[body].torque += applied.torque + arm.cross(applied.force);
    });
    return loads;
}

void addTendons(const State& state, Assembly& assembly) {
    const auto limits = tieLimits(state);
    if (!limits.ok()) return;  // nothing is computed then: limit_analysis.cpp says why
    for (const TieLimit& limit : *limits) {
        const std::int32_t body_a = assembly.body_of_block[static_cast<std::size_t>(limit.between.a)],
                           body_b = assembly.body_of_block[static_cast<std::size_t>(limit.between.b)];
        if (body_a == body_b || std::min(body_a, body_b) == kAbsent) continue;
        assembly.tendons.push_back({body_a, body_b, limit.place, limit.along, limit.strength});
    }
}

/// Whether gravity or an earthquake of any strength has a component out of the plane of x and z.
bool pushesAcross(const State& state) {
    const Model& model = state.geometry->model;
    return bodyAcceleration(state).y() != 0 || pushOf(model.seismic, model.gravity, state.load.tilt).y() != 0;
}

}  // namespace

Assembly assemble(const State& state, const std::vector<std::string>& left_out) {
    Assembly assembly;
    makeBodies(state, absent(state, left_out), assembly);
    for (std::size_t i = 0; i < state.interfaces.size(); ++i) addPoints(state, i, assembly);
    addTendons(state, assembly);
    if (pushesAcross(state) || !assembly.tendons.empty()) return assembly;
    State loaded = state;
    const Loads loads = appliedLoads(loaded, assembly, state.load.tilt);
    return foldToSection(std::move(assembly), loads, state.geometry->length_scale);
}

Loads weightLoads(const State& state, const Assembly& assembly, const Vec3& acceleration) {
    Loads loads(assembly.bodies.size());
    forFreeBlocks(assembly, [&](std::size_t b, std::size_t body) {
        const Vec3 force = state.blocks.mass[b] * acceleration;
        const Vec3 arm = state.blocks.position.get(b) - assembly.bodies[body].centroid;
        loads[body].force += force;
        loads[body].torque += arm.cross(force);
    });
    return loads;
}

Loads appliedLoads(State& state, const Assembly& assembly, double tilt) {
    state.load.tilt = tilt;
    state.load.water_share = 1;
    updateBlockForces(state);
    return presentForces(state, assembly);
}

}  // namespace talus::limit
