#include <algorithm>

#include "validate/findings.h"

namespace talus {
namespace {

constexpr auto kWidth = static_cast<std::size_t>(simd::kLanes);

bool areSized(const Interfaces& f) {
    const std::size_t n = f.size();
    return f.block_b.size() == n && f.face_a.size() == n && f.face_b.size() == n && f.joint.size() == n &&
           f.area.size() == n && f.kind.size() == n && f.idle.size() == n && f.travel_left.size() == n &&
           f.faces_are_apart.size() == n && f.slot.size() == n;
}

/// Groups follow each other without gaps, in interfaces, corners and contact points.
void checkGroups(const Interfaces& f, Findings& findings) {
    InterfaceGroup next;
    for (std::size_t g = 0; g < f.groups.size(); ++g) {
        const InterfaceGroup& group = f.groups[g];
        findings.expect(group.begin == next.begin && group.first_corner == next.first_corner &&
                            group.first_point == next.first_point,
                        "group", g, "it does not begin where the one before ends");
        findings.expect(group.size >= 1 && group.size <= simd::kLanes && group.points >= 1 &&
                            (group.corners == 1 ? group.points == 1 : group.corners >= 3),
                        "group", g, "no interfaces are like that");
        next.begin = group.begin + group.size;
        next.first_corner = group.first_corner + std::int64_t{group.corners} * simd::kLanes;
        next.first_point = group.first_point + std::int64_t{group.points} * simd::kLanes;
    }
    findings.expect(static_cast<std::size_t>(next.begin) == f.size(),
                    "the groups do not hold all interfaces");
    findings.expect(f.corners.slots() == static_cast<std::size_t>(next.first_corner),
                    "corners have not the groups' slots");
    findings.expect(
        f.frames.slots() == f.groups.size() * kWidth && f.wrenches.size() == f.groups.size() * kWidth,
        "frames or wrenches have not the groups' slots");
}

void checkSlots(const Interfaces& f, Findings& findings) {
    for (std::size_t g = 0; g < f.groups.size(); ++g)
        for (std::int32_t k = 0; k < f.groups[g].size; ++k) {
            const auto i = static_cast<std::size_t>(f.groups[g].begin + k);
            findings.expect(f.slot[i] == static_cast<std::int32_t>(g * kWidth) + k, "interface", i,
                            "its slot is not its place in its group");
        }
}

void checkPointSlots(const State& state, Findings& findings) {
    const ContactPoints& points = state.points;
    std::size_t slots = 0, count = 0;
    for (const InterfaceGroup& group : state.interfaces.groups) {
        slots += static_cast<std::size_t>(group.points) * kWidth;
        count += static_cast<std::size_t>(group.points) * static_cast<std::size_t>(group.size);
    }
    const PointRule::Kind kind = state.geometry->model.points.kind;
    const bool derived = kind != PointRule::Kind::quarter && kind != PointRule::Kind::grid;
    findings.expect(points.size() == count, "the count of contact points is not that of the interfaces'");
    findings.expect(points.memory.slots() == slots, "contact points' memory has not the groups' slots");
    findings.expect(points.places.slots() == (derived ? 0 : slots),
                    "contact points' places have not the groups' slots");
    findings.expect(
        points.remembers() || std::none_of(state.laws.begin(), state.laws.end(), contact::hasMemory),
        "a joint has strength to lose or dilates, and contact points do not remember it");
}

/// Whether lanes [used, kLanes) of one row of slots hold nothing but `value`.
bool areUnused(const LaneArray& array, std::size_t row, std::size_t used, std::size_t quantity,
               double value) {
    for (std::size_t lane = used; lane < kWidth; ++lane)
        if (array.get(row + lane, quantity) != value) return false;
    return true;
}

bool areUnused(const LaneArray& array, std::size_t row, std::size_t used) {
    for (std::size_t q = 0; q < array.quantities(); ++q)
        if (!areUnused(array, row, used, q, 0.0)) return false;
    return true;
}

/// Unused lanes beside a group's members must not become a number with an effect, or nan.
void checkUnusedLanes(const State& state, Findings& findings) {
    const Interfaces& f = state.interfaces;
    const ContactPoints& points = state.points;
    for (std::size_t g = 0; g < f.groups.size(); ++g) {
        const InterfaceGroup& group = f.groups[g];
        const auto used = static_cast<std::size_t>(group.size);
        if (used == kWidth) continue;
        bool empty = areUnused(f.frames, g * kWidth, used);
        for (std::size_t k = 0; k < static_cast<std::size_t>(group.corners); ++k)
            empty = empty &&
                    areUnused(f.corners, static_cast<std::size_t>(group.first_corner) + k * kWidth, used);
        for (std::size_t k = 0; k < static_cast<std::size_t>(group.points); ++k) {
            const std::size_t row = static_cast<std::size_t>(group.first_point) + k * kWidth;
            if (!points.places.empty()) empty = empty && areUnused(points.places, row, used);
            for (std::size_t q = 0; q < points.memory.quantities(); ++q)
                empty = empty && areUnused(points.memory, row, used, q, q == 2 ? 1.0 : 0.0);  // the bond
        }
        findings.expect(empty, "group", g, "its unused lanes are not empty");
    }
}

void checkIndices(const State& state, Findings& findings) {
    const Interfaces& f = state.interfaces;
    const auto isBlock = [&](std::int32_t block) {
        return block >= 0 && static_cast<std::size_t>(block) < state.blocks.size();
    };
    const auto isFace = [&](std::int32_t block, std::int32_t face) {
        return face >= 0 && static_cast<std::size_t>(face) <
                                state.geometry->shape[static_cast<std::size_t>(block)].faces.size();
    };
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (!findings.expect(isBlock(f.block_a[i]) && isBlock(f.block_b[i]) && f.block_a[i] != f.block_b[i],
                             "interface", i, "it is not between two blocks"))
            continue;
        findings.expect(isFace(f.block_a[i], f.face_a[i]) && isFace(f.block_b[i], f.face_b[i]), "interface",
                        i, "a block has no such face");
        findings.expect(f.joint[i] >= 0 && static_cast<std::size_t>(f.joint[i]) < state.laws.size(),
                        "interface", i, "there is no such joint");
        findings.expect(f.area[i] > 0, "interface", i, "its area is not positive");
        const bool place = f.kind[i] == InterfaceKind::vertex_edge;
        findings.expect(place == (f.cornerCount(i) == 1), "interface", i,
                        "its kind is not that of its patch");
        findings.expect(place || (f.idle[i] == 0 && f.travel_left[i] == 0 && f.faces_are_apart[i] == 0),
                        "interface", i,
                        "it is between faces and has what places for vertices and edges have");
    }
}

}  // namespace

void checkLayout(const State& state, Findings& findings) {
    const Interfaces& f = state.interfaces;
    if (!findings.expect(areSized(f), "arrays of interfaces differ in size")) return;
    checkGroups(f, findings);
    if (!findings.none()) return;
    checkSlots(f, findings);
    checkPointSlots(state, findings);
    if (!findings.none()) return;
    checkUnusedLanes(state, findings);
    checkIndices(state, findings);
}

}  // namespace talus
