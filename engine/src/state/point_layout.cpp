#include "state/point_layout.h"

#include <algorithm>

#include "contact/points.h"

namespace talus {

void addToGroups(Interfaces& f, std::size_t corners, std::size_t points) {
    const auto m = static_cast<std::int32_t>(corners), n = static_cast<std::int32_t>(points);
    if (f.groups.empty() || f.groups.back().size == simd::kLanes || f.groups.back().corners != m ||
        f.groups.back().points != n) {
        InterfaceGroup next{.begin = static_cast<std::int32_t>(f.group.size()), .corners = m, .points = n};
        if (!f.groups.empty()) {
            const InterfaceGroup& last = f.groups.back();
            next.first_corner = last.first_corner + std::int64_t{last.corners} * simd::kLanes;
            next.first_point = last.first_point + std::int64_t{last.points} * simd::kLanes;
        }
        f.groups.push_back(next);
    }
    ++f.groups.back().size;
    f.group.push_back(static_cast<std::int32_t>(f.groups.size()) - 1);
}

void placeCorners(Interfaces& f, std::size_t i, const std::vector<Eigen::Vector2d>& outline) {
    const std::size_t slots = static_cast<std::size_t>(f.groupOf(i).first_corner) +
                              outline.size() * static_cast<std::size_t>(simd::kLanes);
    f.patch_xi.resize(slots, 0.0);
    f.patch_eta.resize(slots, 0.0);
    for (std::size_t k = 0; k < outline.size(); ++k) {
        f.patch_xi[f.cornerSlot(i, k)] = outline[k].x();
        f.patch_eta[f.cornerSlot(i, k)] = outline[k].y();
    }
}

std::vector<Eigen::Vector2d> patchOutline(const Interfaces& f, std::size_t i) {
    std::vector<Eigen::Vector2d> outline(f.cornerCount(i));
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const std::size_t slot = f.cornerSlot(i, k);
        outline[k] = {f.patch_xi[slot], f.patch_eta[slot]};
    }
    return outline;
}

std::vector<contact::PatchPoint> interfacePoints(const Interfaces& f, std::size_t i, const PointRule& rule) {
    const std::vector<Eigen::Vector2d> outline = patchOutline(f, i);
    if (outline.size() == 1) return {{outline[0], f.area[i]}};
    return contact::patchPoints(outline, rule);
}

void makePoints(State& state) {
    const Interfaces& f = state.interfaces;
    ContactPoints& points = state.points;
    points = {};
    std::size_t slots = 0;
    for (const InterfaceGroup& group : f.groups) {
        slots += static_cast<std::size_t>(group.points * simd::kLanes);
        points.count += static_cast<std::size_t>(group.points * group.size);
    }
    points.offset_1.assign(slots, 0.0);
    points.offset_2.assign(slots, 0.0);
    if (std::any_of(state.laws.begin(), state.laws.end(), contact::hasMemory)) {
        points.bond.assign(slots, 1.0);
        points.dilation.assign(slots, 0.0);
    }
    const PointRule& rule = state.geometry->model.points;
    if (rule.kind == PointRule::Kind::vertex || rule.kind == PointRule::Kind::corner) return;
    for (auto* values : {&points.xi, &points.eta, &points.area}) values->assign(slots, 0.0);
    for (std::size_t i = 0; i < f.size(); ++i) {
        std::size_t k = 0;
        for (const contact::PatchPoint& point : interfacePoints(f, i, rule)) {
            const std::size_t slot = f.pointSlot(i, k++);
            points.xi[slot] = point.position.x();
            points.eta[slot] = point.position.y();
            points.area[slot] = point.area;
        }
    }
}

}  // namespace talus
