#include "stages/carry_over.h"

#include <algorithm>
#include <array>
#include <map>

namespace talus::stages {
namespace {

using Key = std::array<std::int32_t, 4>;

Key keyOf(const Interfaces& f, std::size_t i) {
    return {f.block_a[i], f.block_b[i], f.face_a[i], f.face_b[i]};
}

/// Where the new origin lies in the old interface's plane: both origins and tangents belong to the same face of a.
Eigen::Vector2d originShift(const Interfaces& old, std::size_t o, const Interfaces& now, std::size_t n) {
    const Vec3 d = now.origin_a.get(n) - old.origin_a.get(o);
    return {d.dot(old.e1_a.get(o)), d.dot(old.e2_a.get(o))};
}

std::size_t nearestPoint(const OldInterfaces& old, std::size_t o, double xi, double eta) {
    const auto begin = static_cast<std::size_t>(old.interfaces.point_begin[o]);
    const auto end = static_cast<std::size_t>(old.interfaces.point_begin[o + 1]);
    std::size_t best = begin;
    double best_distance = kInfinity;
    for (std::size_t p = begin; p < end; ++p) {
        const double dx = old.points.xi[p] - xi, dy = old.points.eta[p] - eta;
        if (dx * dx + dy * dy >= best_distance) continue;
        best_distance = dx * dx + dy * dy;
        best = p;
    }
    return best;
}

/// Returns the shear force that found no closed Lp [N].
double carryInterface(const OldInterfaces& old, std::size_t o, State& state, std::size_t n) {
    Interfaces& f = state.interfaces;
    ContactPoints& points = state.points;
    const Eigen::Vector2d shift = originShift(old.interfaces, o, f, n);
    const Vec3 gap = old.interfaces.reference_gap.get(o);
    f.reference_gap.set(n, {gap.x() + shift.x() * gap.y() + shift.y() * gap.z(), gap.y(), gap.z()});

    const contact::JointLaw& law = state.laws[static_cast<std::size_t>(f.joint[n])];
    const auto begin = static_cast<std::size_t>(f.point_begin[n]),
               end = static_cast<std::size_t>(f.point_begin[n + 1]);
    Eigen::Vector2d missing = Eigen::Vector2d::Zero();
    for (auto q = static_cast<std::size_t>(old.interfaces.point_begin[o]);
         q < static_cast<std::size_t>(old.interfaces.point_begin[o + 1]); ++q)
        missing += Eigen::Vector2d(old.points.shear_1[q], old.points.shear_2[q]);
    double closed_area = 0;
    for (std::size_t p = begin; p < end; ++p) {
        const std::size_t q = nearestPoint(old, o, points.xi[p] + shift.x(), points.eta[p] + shift.y());
        const double share = points.area[p] / old.points.area[q];
        points.bond[p] = old.points.bond[q];
        if (!points.dilation.empty()) points.dilation[p] = old.points.dilation[q];
        points.normal[p] = share * old.points.normal[q];
        points.shear_1[p] = share * old.points.shear_1[q];
        points.shear_2[p] = share * old.points.shear_2[q];
        missing -= Eigen::Vector2d(points.shear_1[p], points.shear_2[p]);
        if (points.normal[p] != 0.0) closed_area += points.area[p];
    }
    for (std::size_t p = begin; p < end; ++p) {
        if (points.normal[p] != 0.0) {
            points.shear_1[p] += missing.x() * points.area[p] / closed_area;
            points.shear_2[p] += missing.y() * points.area[p] / closed_area;
        }
        // The slide is zero at the clipping, so the offset alone holds the shear force: F_s = k_s A offset.
        points.offset_1[p] = points.shear_1[p] / (law.shear_stiffness * points.area[p]);
        points.offset_2[p] = points.shear_2[p] / (law.shear_stiffness * points.area[p]);
    }
    return closed_area > 0 ? 0.0 : missing.norm();
}

/// Shear force that an interface carries [N].
double shearForce(const OldInterfaces& old, std::size_t o) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (auto q = static_cast<std::size_t>(old.interfaces.point_begin[o]);
         q < static_cast<std::size_t>(old.interfaces.point_begin[o + 1]); ++q)
        sum += Eigen::Vector2d(old.points.shear_1[q], old.points.shear_2[q]);
    return sum.norm();
}

}  // namespace

bool anyDilates(const std::vector<contact::JointLaw>& laws) {
    return std::any_of(laws.begin(), laws.end(),
                       [](const contact::JointLaw& law) { return law.tan_dilation != 0; });
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
    for (const auto& [key, o] : old_index) lost += shearForce(old, o);
    return lost;
}

}  // namespace talus::stages
