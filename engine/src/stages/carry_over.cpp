#include "stages/carry_over.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "contact/points.h"

namespace talus::stages {
namespace {

using Key = std::array<std::int32_t, 4>;

Key keyOf(const Interfaces& f, std::size_t i) {
    return {f.block_a[i], f.block_b[i], f.face_a[i], f.face_b[i]};
}

/// Where the new origin lies in the old interface's plane: both origins and tangents belong to the same face of a.
Eigen::Vector2d originShift(const InterfaceFrame& old, const InterfaceFrame& now) {
    const Vec3 d = now.origin_a - old.origin_a;
    return {d.dot(old.e1_a), d.dot(old.e2_a)};
}

const PointState& nearestPoint(const std::vector<PointState>& points, const Eigen::Vector2d& place) {
    return *std::min_element(points.begin(), points.end(), [&](const PointState& p, const PointState& q) {
        return (p.position - place).squaredNorm() < (q.position - place).squaredNorm();
    });
}

/// Shear force that an interface carries, along its tangents [N].
Eigen::Vector2d shearForce(const std::vector<PointState>& points) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const PointState& p : points) sum += Eigen::Vector2d(p.force.shear_1, p.force.shear_2);
    return sum;
}

/// Returns the shear force that found no closed Lp [N].
double carryInterface(const OldInterfaces& old, std::size_t o, State& state, std::size_t n) {
    Interfaces& f = state.interfaces;
    ContactPoints& points = state.points;
    const InterfaceFrame then = old.interfaces.frame(o);
    const Eigen::Vector2d shift = originShift(then, f.frame(n));
    const Vec3& gap = then.reference_gap;
    f.setReferenceGap(n, {gap.x() + shift.x() * gap.y() + shift.y() * gap.z(), gap.y(), gap.z()});

    const contact::JointLaw& law = state.laws[static_cast<std::size_t>(f.joint[n])];
    const auto places = contact::patchPoints(patchOutline(f, n), state.geometry->model.points);
    std::vector<Eigen::Vector2d> shear(places.size());
    std::vector<bool> closed(places.size());
    Eigen::Vector2d missing = shearForce(old.points[o]);
    double closed_area = 0;
    for (std::size_t k = 0; k < places.size(); ++k) {
        const PointState& q = nearestPoint(old.points[o], places[k].position + shift);
        const std::size_t slot = f.pointSlot(n, k);
        points.setMemory(slot, q.memory);
        shear[k] = places[k].area / q.area * Eigen::Vector2d(q.force.shear_1, q.force.shear_2);
        closed[k] = q.force.normal != 0.0;
        missing -= shear[k];
        if (closed[k]) closed_area += places[k].area;
    }
    for (std::size_t k = 0; k < places.size(); ++k) {
        if (closed[k]) shear[k] += missing * places[k].area / closed_area;
        // The slide is zero at the clipping, so the offset alone holds the shear force: F_s = k_s A offset.
        const Eigen::Vector2d offset = shear[k] / (law.shear_stiffness * places[k].area);
        contact::PointMemory memory = points.memoryAt(f.pointSlot(n, k));
        memory.offset_1 = offset.x();
        memory.offset_2 = offset.y();
        points.setMemory(f.pointSlot(n, k), memory);
    }
    return closed_area > 0 ? 0.0 : missing.norm();
}

}  // namespace

OldInterfaces takeInterfaces(State& state) {
    OldInterfaces old;
    for (std::size_t i = 0; i < state.interfaces.size(); ++i) old.points.push_back(pointStates(state, i));
    old.interfaces = std::exchange(state.interfaces, {});
    state.points = {};
    return old;
}

double carryOver(const OldInterfaces& old, State& state) {
    std::map<Key, std::size_t> old_index;
    for (std::size_t o = 0; o < old.interfaces.size(); ++o) old_index[keyOf(old.interfaces, o)] = o;
    double lost = 0;
    for (std::size_t n = 0; n < state.interfaces.size(); ++n) {
        const auto found = old_index.find(keyOf(state.interfaces, n));
        if (found == old_index.end()) continue;
        lost += carryInterface(old, found->second, state, n);
        old_index.erase(found);
    }
    for (const auto& [key, o] : old_index) lost += shearForce(old.points[o]).norm();
    return lost;
}

}  // namespace talus::stages
