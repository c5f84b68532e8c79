#include "state/point_layout.h"

#include <algorithm>
#include <cassert>

#include "law/points.h"

namespace talus {

void addToGroups(Interfaces& f, std::size_t corners, std::size_t points) {
    assert((corners >= 3 && points >= 1) || (corners == 1 && points == 1));
    const auto m = static_cast<std::int32_t>(corners), n = static_cast<std::int32_t>(points);
    if (f.groups.empty() || f.groups.back().size == simd::kLanes || f.groups.back().corners != m ||
        f.groups.back().points != n) {
        InterfaceGroup next{.begin = static_cast<std::int32_t>(f.slot.size()), .corners = m, .points = n};
        if (!f.groups.empty()) {
            const InterfaceGroup& last = f.groups.back();
            next.first_corner = last.first_corner + std::int64_t{last.corners} * simd::kLanes;
            next.first_point = last.first_point + std::int64_t{last.points} * simd::kLanes;
        }
        f.groups.push_back(next);
        const std::size_t slots = f.groups.size() * static_cast<std::size_t>(simd::kLanes);
        f.frames.grow(slots);
        f.wrenches.resize(slots);
    }
    f.slot.push_back((static_cast<std::int32_t>(f.groups.size()) - 1) * simd::kLanes +
                     f.groups.back().size++);
}

void growCorners(Interfaces& f, std::size_t i) {
    assert(i < f.slot.size());
    const std::size_t slots = static_cast<std::size_t>(f.groupOf(i).first_corner) +
                              f.cornerCount(i) * static_cast<std::size_t>(simd::kLanes);
    if (f.corners.slots() < slots) f.corners.grow(slots);
}

void placeCorners(Interfaces& f, std::size_t i, const std::vector<Eigen::Vector2d>& outline) {
    assert(i < f.slot.size() && outline.size() == f.cornerCount(i));
    growCorners(f, i);
    for (std::size_t k = 0; k < outline.size(); ++k) {
        f.corners.set(f.cornerSlot(i, k), 0, outline[k].x());
        f.corners.set(f.cornerSlot(i, k), 1, outline[k].y());
    }
}

std::vector<Eigen::Vector2d> patchOutline(const Interfaces& f, std::size_t i) {
    std::vector<Eigen::Vector2d> outline(f.cornerCount(i));
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const std::size_t slot = f.cornerSlot(i, k);
        outline[k] = {f.corners.get(slot, 0), f.corners.get(slot, 1)};
    }
    return outline;
}

contact::PointMemory ContactPoints::memoryAt(std::size_t slot) const {
    contact::PointMemory result{.offset_1 = memory.get(slot, 0), .offset_2 = memory.get(slot, 1)};
    if (remembers()) {
        result.bond = memory.get(slot, 2);
        result.dilation = memory.get(slot, 3);
    }
    return result;
}

void ContactPoints::setMemory(std::size_t slot, const contact::PointMemory& value) {
    memory.set(slot, 0, value.offset_1);
    memory.set(slot, 1, value.offset_2);
    if (!remembers()) return;
    memory.set(slot, 2, value.bond);
    memory.set(slot, 3, value.dilation);
}

contact::PatchPoint onlyPoint(const Interfaces& interfaces, std::size_t interface) {
    assert(interfaces.cornerCount(interface) == 1);
    const std::size_t slot = interfaces.cornerSlot(interface, 0);
    return {{interfaces.corners.get(slot, 0), interfaces.corners.get(slot, 1)}, interfaces.area[interface]};
}

std::vector<contact::PatchPoint> interfacePoints(const Interfaces& f, std::size_t i, const PointRule& rule) {
    if (f.cornerCount(i) == 1) return {onlyPoint(f, i)};
    return contact::patchPoints(patchOutline(f, i), rule);
}

void makePoints(State& state) {
    const Interfaces& f = state.interfaces;
    assert(f.slot.size() == f.size() && f.area.size() == f.size());
    ContactPoints& points = state.points;
    points = {};
    std::size_t slots = 0;
    for (const InterfaceGroup& group : f.groups) {
        slots += static_cast<std::size_t>(group.points * simd::kLanes);
        points.count += static_cast<std::size_t>(group.points * group.size);
    }
    const bool remembers = std::any_of(state.laws.begin(), state.laws.end(), contact::hasMemory);
    points.memory = LaneArray(remembers ? kMemoryQuantities : kSlideQuantities);
    points.memory.grow(slots);
    if (remembers)
        for (std::size_t slot = 0; slot < slots; ++slot) points.setBond(slot, 1.0);
    const PointRule& rule = state.geometry->model.points;
    if (rule.kind != PointRule::Kind::quarter && rule.kind != PointRule::Kind::grid) return;
    points.places.grow(slots);
    for (std::size_t i = 0; i < f.size(); ++i) {
        std::size_t k = 0;
        for (const contact::PatchPoint& point : interfacePoints(f, i, rule)) {
            assert(k < f.pointCount(i));
            const std::size_t slot = f.pointSlot(i, k++);
            points.places.set(slot, 0, point.position.x());
            points.places.set(slot, 1, point.position.y());
            points.places.set(slot, 2, point.area);
        }
    }
}

}  // namespace talus
