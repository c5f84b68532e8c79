#include "contacts/carry_over.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "law/points.h"
#include "state/block_motion.h"
#include "state/incidence.h"
#include "state/placed_shape.h"

namespace talus {
namespace {

using Key = std::array<std::int32_t, 4>;

Key keyOf(const Interfaces& f, std::size_t i) {
    return {f.block_a[i], f.block_b[i], f.face_a[i], f.face_b[i]};
}

/// Where the new origin lies in the old interface's plane: both origins and tangents belong to the same face
/// of a.
Eigen::Vector2d originShift(const InterfaceFrame& old, const InterfaceFrame& now) {
    const Vec3 d = now.origin_a - old.origin_a;
    return {d.dot(old.e1_a), d.dot(old.e2_a)};
}

const ContactPoint& nearestPoint(const std::vector<ContactPoint>& points, const Eigen::Vector2d& place) {
    return *std::min_element(points.begin(), points.end(), [&](const ContactPoint& p, const ContactPoint& q) {
        return (p.position - place).squaredNorm() < (q.position - place).squaredNorm();
    });
}

/// Shear force that an interface carries, along its tangents [N].
Eigen::Vector2d shearForce(const std::vector<ContactPoint>& points) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const ContactPoint& p : points) sum += Eigen::Vector2d(p.force.shear_1, p.force.shear_2);
    return sum;
}

// A slipping contact point keeps slipping on its new area: it gets slightly more than its strength, which the
// law cuts.
constexpr double kStillSlipping = 1.1;

bool isSlipping(const contact::JointLaw& law, const ContactPoint& point) {
    constexpr double kAtStrength = 1.0 - 1e-9;
    const double strength =
        contact::shearStrength(law, point.area, point.force.normal, point.memory.bond, point.cohesive);
    return strength > 0 && std::hypot(point.force.shear_1, point.force.shear_2) >= kAtStrength * strength;
}

/// Returns the shear force that found no closed contact point [N].
double carryInterface(const OldInterfaces& old, std::size_t o, State& state, std::size_t n) {
    Interfaces& f = state.interfaces;
    ContactPoints& points = state.points;
    const InterfaceFrame then = old.interfaces.frame(o);
    const Eigen::Vector2d shift = originShift(then, f.frame(n));
    const Vec3& gap = then.reference_gap;
    f.setReferenceGap(n, {gap.x() + shift.x() * gap.y() + shift.y() * gap.z(), gap.y(), gap.z()});

    const std::vector<ContactPoint> old_points = contactPoints(old.contacts(state), o);
    const contact::JointLaw& law = state.laws[static_cast<std::size_t>(f.joint[n])];
    const auto places = contact::patchPoints(patchOutline(f, n), state.geometry->model.points);
    std::vector<Eigen::Vector2d> shear(places.size());
    std::vector<bool> closed(places.size()), slips(places.size());
    Eigen::Vector2d missing = shearForce(old_points);
    double closed_area = 0;
    for (std::size_t k = 0; k < places.size(); ++k) {
        const ContactPoint& q = nearestPoint(old_points, places[k].position + shift);
        const std::size_t slot = f.pointSlot(n, k);
        points.setMemory(slot, q.memory);
        shear[k] = places[k].area / q.area * Eigen::Vector2d(q.force.shear_1, q.force.shear_2);
        slips[k] = isSlipping(law, q);
        closed[k] = q.force.normal != 0.0;
        missing -= shear[k];
        if (closed[k]) closed_area += places[k].area;
    }
    for (std::size_t k = 0; k < places.size(); ++k) {
        if (closed[k]) shear[k] += missing * places[k].area / closed_area;
        if (slips[k]) shear[k] *= kStillSlipping;
        // The slide is zero at the clipping, so the offset alone holds the shear force: F_s = k_s A offset.
        points.setOffset(f.pointSlot(n, k), contact::offsetFor(law, places[k].area, shear[k].x()),
                         contact::offsetFor(law, places[k].area, shear[k].y()));
    }
    return closed_area > 0 ? 0.0 : missing.norm();
}

constexpr double kNearPoint =
    0.1;  // of the root of the patch area: a new interface's contact point this near takes the shear force
constexpr double kDeeper =
    1.05;  // times the deepest contact of the blocks; an elastic turn makes it a little more
constexpr double kDeepest = 1e-7;  // of the smaller block's size: less is ignored

std::vector<double> deepestContacts(const State& state, const std::vector<char>& near) {
    const Interfaces& f = state.interfaces;
    std::vector<double> deepest(state.blocks.size(), 0.0);
    const auto is_near = [&](std::int32_t block) {
        return near.empty() || near[static_cast<std::size_t>(block)] != 0;
    };
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (isIdle(f, i) || !(is_near(f.block_a[i]) || is_near(f.block_b[i]))) continue;
        const contact::JointLaw& law = state.laws[static_cast<std::size_t>(f.joint[i])];
        for (const ContactPoint& point : contactPoints(state, i))
            for (const std::int32_t block : {f.block_a[i], f.block_b[i]}) {
                const auto b = static_cast<std::size_t>(block);
                if (state.blocks.motion[b] != Motion::fixed)
                    deepest[b] =
                        std::max(deepest[b], contact::overlapFor(law, point.area, point.force.normal));
            }
    }
    return deepest;
}

/// An interface that has opened closes again at its faces. One deeper than its blocks' contacts were takes
/// that depth as its reference.
void setBackGap(const OldInterfaces& old, State& state, std::size_t i) {
    Interfaces& f = state.interfaces;
    const RelativePose pose = relativePose(state, i);
    double least = kInfinity;
    for (const Eigen::Vector2d& v : patchOutline(f, i))
        least = std::min(least, pose.gap.x() + v.x() * pose.gap.y() + v.y() * pose.gap.z());
    const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
    const double allowed = kDeeper * std::max(old.depth[a], old.depth[b]) +
                           kDeepest * std::min(state.geometry->size[a], state.geometry->size[b]);
    double& reference = f.referenceGap(i, 0);
    if (least < -allowed)
        reference += least + allowed;
    else if (least > 0 && reference < 0)
        reference = std::min(0.0, reference + least);
}

/// A place is kept as it is.
void carryPlace(const OldInterfaces& old, std::size_t o, State& state, std::size_t n) {
    const Interfaces& from = old.interfaces;
    Interfaces& f = state.interfaces;
    for (auto index : {&Interfaces::block_a, &Interfaces::block_b, &Interfaces::face_a, &Interfaces::face_b,
                       &Interfaces::joint})
        (f.*index)[n] = (from.*index)[o];
    f.idle[n] = from.idle[o];
    f.travel_left[n] = from.travel_left[o];
    f.faces_are_apart[n] = from.faces_are_apart[o];
    f.setFrame(n, from.frame(o));
    f.setWrench(n, from.wrench(o));
    state.points.setMemory(f.pointSlot(n, 0), old.points.memoryAt(from.pointSlot(o, 0)));
}

/// Interfaces outside the search are kept as they are.
void keepMemory(const OldInterfaces& old, std::size_t o, State& state, std::size_t n) {
    for (std::size_t k = 0; k < state.interfaces.pointCount(n); ++k) {
        const contact::PointMemory memory = old.points.memoryAt(old.interfaces.pointSlot(o, k));
        state.points.setMemory(state.interfaces.pointSlot(n, k), memory);
    }
}

/// Shear force of other contacts of the same blocks goes to the nearest closed contact points of a new pair
/// of faces.
void takeShear(const std::vector<CarriedPoint>& carried, State& state, std::size_t i) {
    const Interfaces& f = state.interfaces;
    const RelativePose pose = relativePose(state, i);
    const contact::JointLaw& law = state.laws[static_cast<std::size_t>(f.joint[i])];
    const double sign = f.block_a[i] < f.block_b[i] ? 1.0 : -1.0;
    const std::vector<ContactPoint> points = contactPoints(state, i);
    for (const CarriedPoint& from : carried) {
        std::size_t nearest = points.size();
        double least = kNearPoint * std::sqrt(f.area[i]);
        for (std::size_t k = 0; k < points.size(); ++k) {
            const Vec3 place =
                pose.origin + points[k].position.x() * pose.e1 + points[k].position.y() * pose.e2;
            if (points[k].force.normal <= 0 || (place - from.place).norm() > least) continue;
            least = (place - from.place).norm();
            nearest = k;
        }
        if (nearest == points.size()) continue;
        const auto offset = [&](const Vec3& tangent) {
            return contact::offsetFor(law, points[nearest].area, sign * from.shear.dot(tangent));
        };
        const std::size_t slot = f.pointSlot(i, nearest);
        const contact::PointMemory memory = state.points.memoryAt(slot);
        state.points.setOffset(slot, memory.offset_1 + offset(pose.e1), memory.offset_2 + offset(pose.e2));
    }
}

/// A contact made since the last look has slid since: for up to `ahead` [s] at its present speed.
void startSliding(State& state, std::size_t i, double ahead) {
    const Interfaces& f = state.interfaces;
    const RelativePose pose = relativePose(state, i);
    const auto velocityOf = [&](std::int32_t block) {
        return velocityAt(state.blocks, static_cast<std::size_t>(block), pose.origin);
    };
    const Vec3 slide = ahead * (velocityOf(f.block_b[i]) - velocityOf(f.block_a[i]));
    for (std::size_t k = 0; k < f.pointCount(i); ++k)
        state.points.setOffset(f.pointSlot(i, k), -slide.dot(pose.e1), -slide.dot(pose.e2));
}

}  // namespace

OldInterfaces takeInterfaces(State& state, const std::vector<char>& near) {
    OldInterfaces old;
    old.depth = deepestContacts(state, near);
    old.interfaces = std::exchange(state.interfaces, {});
    old.points = std::exchange(state.points, {});
    return old;
}

CarriedPoints carryOver(const OldInterfaces& old, State& state, double ahead) {
    assert(ahead >= 0 && old.depth.size() == state.blocks.size());
    assert(old.points.remembers() == state.points.remembers());
    const Interfaces& f = state.interfaces;
    const Geometry& geometry = *state.geometry;
    std::map<Key, std::size_t> faces;  // of face to face interfaces
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::size_t>> slots;  // of pairs of parts
    std::vector<char> is_kept(f.size(), 0);
    for (std::size_t o = 0; o < old.interfaces.size(); ++o) {
        if (!old.kept_as.empty() && old.kept_as[o] >= 0) {
            const auto n = static_cast<std::size_t>(old.kept_as[o]);
            keepMemory(old, o, state, n);
            is_kept[n] = 1;
            continue;
        }
        if (isVertexEdge(old.interfaces, o))
            slots[partsOf(geometry, old.interfaces, o)].push_back(o);
        else
            faces[keyOf(old.interfaces, o)] = o;
    }
    std::vector<std::size_t> new_faces;
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> next_place;
    for (std::size_t n = 0; n < f.size(); ++n) {
        if (is_kept[n]) continue;
        if (isVertexEdge(f, n)) {
            const auto pair = partsOf(geometry, f, n);
            const auto found = slots.find(pair);
            if (found == slots.end()) continue;
            std::size_t& next = next_place[pair];
            assert(next < found->second.size());
            carryPlace(old, found->second[next++], state, n);
            continue;
        }
        const auto found = faces.find(keyOf(f, n));
        if (found == faces.end()) {
            new_faces.push_back(n);
        } else {
            state.shear_lost += carryInterface(old, found->second, state, n);
            faces.erase(found);
        }
        setBackGap(old, state, n);
    }
    // The memory of faces and places that no longer exist.
    CarriedPoints carried;
    const auto carry = [&](std::size_t o) {
        auto& of_pair = carried[partsOf(geometry, old.interfaces, o)];
        const std::vector<CarriedPoint> points = carriedPoints(old.contacts(state), o);
        of_pair.insert(of_pair.end(), points.begin(), points.end());
    };
    for (const auto& [key, o] : faces) carry(o);
    for (const auto& [pair, of_pair] : slots)
        if (next_place.find(pair) == next_place.end()) std::for_each(of_pair.begin(), of_pair.end(), carry);
    std::set<std::pair<std::int32_t, std::int32_t>> with_new_face;
    for (const std::size_t n : new_faces) with_new_face.insert(partsOf(geometry, f, n));
    for (const auto& [pair, points] : carried) {
        const bool goes_on = next_place.find(pair) != next_place.end() || with_new_face.count(pair) > 0;
        for (const CarriedPoint& point : points)
            if (!goes_on) state.shear_lost += point.shear.norm();
    }
    for (const std::size_t n : new_faces) {
        const auto pair = partsOf(geometry, f, n);
        if (carried.count(pair) == 0 && slots.count(pair) == 0) startSliding(state, n, ahead);
        if (const auto found = carried.find(pair); found != carried.end()) takeShear(found->second, state, n);
        if (const auto found = slots.find(pair); found != slots.end())
            for (const std::size_t o : found->second)
                takeShear(carriedPoints(old.contacts(state), o), state, n);
    }
    return carried;
}

}  // namespace talus
