#include "block_theory/column_row.h"

#include <algorithm>
#include <cmath>

#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "model/plain_joint.h"
#include "state/closed_gap.h"
#include "state/incidence.h"
#include "state/point_layout.h"

namespace talus::keyblocks {
namespace {

// Of unit vectors, and of lengths over the size of the smallest block: files have six digits at least.
constexpr double kSame = 1e-5;

/// A closed contact of a free block: the outline of its patch, and its normal out of the block.
struct Touch {
    std::size_t other = 0;
    double tan_friction = 0;
    Vec3 out;
    std::vector<Vec3> outline{};
};

/// By block, the free ones' contacts that are closed at the start.
using Touches = std::vector<std::vector<Touch>>;

std::vector<Vec3> outlineOf(const State& state, std::size_t i, const RelativePose& pose) {
    std::vector<Vec3> outline;
    for (const Vec2& corner : patchOutline(state.interfaces, i))
        outline.push_back(pose.origin + corner.x() * pose.e1 + corner.y() * pose.e2);
    return outline;
}

/// Bolts without pretension carry nothing until blocks move: limit equilibrium would leave them out.
bool hasBoltsAtRest(const State& state) {
    const auto& bolts = state.geometry->model.bolts;
    return std::any_of(bolts.begin(), bolts.end(), [](const Bolt& bolt) { return !(bolt.pretension > 0); });
}

/// Nothing where a contact has more than friction, or is one of a vertex or of edges.
std::optional<Touches> touchesOf(const State& state) {
    const Interfaces& f = state.interfaces;
    Touches touches(state.blocks.size());
    for (std::size_t i = 0; i < f.size(); ++i) {
        const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
        if (isIdle(f, i) || (state.blocks.free[a] == 0 && state.blocks.free[b] == 0)) continue;
        const RelativePose pose = relativePose(state, i);
        if (pose.gap.x() > kClosedGap * std::min(state.geometry->size[a], state.geometry->size[b])) continue;
        const Joint& joint = state.geometry->model.joints[static_cast<std::size_t>(f.joint[i])];
        if (isVertexEdge(f, i) || !isPlainCoulomb(joint) || !partsFreely(joint)) return std::nullopt;
        const double tan_friction = std::tan(strengthAt(joint, state.load.time).friction);
        const std::vector<Vec3> outline = outlineOf(state, i, pose);
        touches[b].push_back({a, tan_friction, -pose.e3, outline});
        touches[a].push_back({b, tan_friction, pose.e3, outline});
    }
    return touches;
}

bool isFree(const State& state, std::size_t block) { return state.blocks.free[block] != 0; }

std::vector<std::size_t> freeBlocks(const State& state) {
    std::vector<std::size_t> free;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        if (isFree(state, b)) free.push_back(b);
    return free;
}

/// The plane across which nothing changes. Coordinates in it are along `e1` and `e2`.
struct SectionPlane {
    Vec3 e1, e2, across;

    Vec2 in(const Vec3& v) const { return {v.dot(e1), v.dot(e2)}; }
    bool has(const Vec3& direction) const { return std::abs(direction.dot(across)) <= kSame; }
};

/// The plane of all normals; nothing where they span none, or space.
std::optional<SectionPlane> sectionOf(const Touches& touches) {
    std::vector<Vec3> normals;
    for (const auto& of_block : touches)
        for (const Touch& touch : of_block) normals.push_back(touch.out);
    if (normals.empty()) return std::nullopt;
    Vec3 across = Vec3::Zero();
    for (const Vec3& normal : normals) {
        const Vec3 other = normals.front().cross(normal);
        if (other.norm() > across.norm()) across = other;
    }
    if (!(across.norm() > kSame)) return std::nullopt;
    SectionPlane plane{normals.front(), {}, across.normalized()};
    plane.e2 = plane.across.cross(plane.e1);
    const bool flat =
        std::all_of(normals.begin(), normals.end(), [&](const Vec3& normal) { return plane.has(normal); });
    return flat ? std::optional(plane) : std::nullopt;
}

/// Whether each contact is a rectangle across the section, all between the same two planes.
bool haveOneWidth(const Touches& touches, const Vec3& across, double same) {
    double low = kInfinity, high = -kInfinity;
    for (const auto& of_block : touches)
        for (const Touch& touch : of_block)
            for (const Vec3& corner : touch.outline) {
                low = std::min(low, corner.dot(across));
                high = std::max(high, corner.dot(across));
            }
    const auto isAtEnd = [&](const Vec3& corner) {
        const double at = corner.dot(across);
        return at <= low + same || at >= high - same;
    };
    return std::all_of(touches.begin(), touches.end(), [&](const auto& of_block) {
        return std::all_of(of_block.begin(), of_block.end(), [&](const Touch& touch) {
            const auto spans = [&](double at) {
                return std::any_of(touch.outline.begin(), touch.outline.end(), [&](const Vec3& corner) {
                    return std::abs(corner.dot(across) - at) <= same;
                });
            };
            return spans(low) && spans(high) &&
                   std::all_of(touch.outline.begin(), touch.outline.end(), isAtEnd);
        });
    });
}

/// The corner of some contacts that lies farthest along a direction of the section.
Vec2 farthest(const std::vector<const Touch*>& touches, const SectionPlane& plane, const Vec2& along) {
    Vec2 best = plane.in(touches.front()->outline.front());
    for (const Touch* touch : touches)
        for (const Vec3& corner : touch->outline)
            if (plane.in(corner).dot(along) > best.dot(along)) best = plane.in(corner);
    return best;
}

/// What one block of the row touches: fixed rock below and uphill of it, and its neighbours.
struct Stand {
    std::vector<const Touch*> base{}, uphill{}, front{}, behind{};
    Vec2 base_normal, downhill;
};

/// Adds a contact with a free neighbour; false where another one is there.
bool addNeighbour(const Touch& touch, std::vector<const Touch*>& to) {
    if (!to.empty() && to.front()->other != touch.other) return false;
    to.push_back(&touch);
    return true;
}

bool isParallel(const Vec2& a, const Vec2& b) { return (a - b).norm() <= kSame; }

/// Downhill along a plane with this upward normal, under this acceleration; zero where it is level.
Vec2 downhillAlong(const Vec2& normal, const Vec2& acceleration) {
    const Vec2 along = acceleration - acceleration.dot(normal) * normal;
    return along.norm() > kSame * acceleration.norm() ? along.normalized() : Vec2::Zero();
}

/// Fixed rock below: the plane that carries the most of the block's weight. Side faces that lean carry some.
std::optional<Vec2> baseNormalOf(const State& state, const std::vector<Touch>& touches,
                                 const SectionPlane& plane, const Vec2& acceleration) {
    std::optional<Vec2> best;
    for (const Touch& touch : touches) {
        const Vec2 into = plane.in(-touch.out);
        if (isFree(state, touch.other) || into.dot(acceleration) >= 0) continue;
        if (!best || into.dot(acceleration) < best->dot(acceleration)) best = into;
    }
    return best;
}

/// Whether fixed rock uphill is a step or wall in line with the side faces. Rock that faces otherwise, as a
/// roof, carries or presses.
bool isStepBehind(const Stand& stand, const SectionPlane& plane) {
    if (stand.uphill.empty()) return true;
    if (stand.behind.empty() && stand.front.empty()) return false;
    const Vec2 side = stand.behind.empty() ? Vec2(-plane.in(stand.front.front()->out))
                                           : plane.in(stand.behind.front()->out);
    return std::all_of(stand.uphill.begin(), stand.uphill.end(),
                       [&](const Touch* touch) { return isParallel(plane.in(touch->out), side); });
}

/// Nothing where the block is no column: on no base, held from downhill, or with two neighbours on a side.
std::optional<Stand> standOf(const State& state, const std::vector<Touch>& touches, const SectionPlane& plane,
                             const Vec2& acceleration) {
    const auto base_normal = baseNormalOf(state, touches, plane, acceleration);
    if (!base_normal) return std::nullopt;
    Stand stand{.base_normal = *base_normal, .downhill = downhillAlong(*base_normal, acceleration)};
    if (stand.downhill.isZero()) return std::nullopt;
    for (const Touch& touch : touches) {
        const Vec2 out = plane.in(touch.out);
        const bool is_in_front = out.dot(stand.downhill) > 0;
        if (isFree(state, touch.other)) {
            if (!addNeighbour(touch, is_in_front ? stand.front : stand.behind)) return std::nullopt;
        } else if (isParallel(-out, stand.base_normal)) {
            stand.base.push_back(&touch);
        } else if (is_in_front) {
            return std::nullopt;
        } else {
            stand.uphill.push_back(&touch);
        }
    }
    if (!isStepBehind(stand, plane)) return std::nullopt;
    return stand;
}

/// One face, so one normal and one friction.
bool isOneFace(const std::vector<const Touch*>& touches, const SectionPlane& plane) {
    return std::all_of(touches.begin(), touches.end(), [&](const Touch* touch) {
        return isParallel(plane.in(touch->out), plane.in(touches.front()->out)) &&
               touch->tan_friction == touches.front()->tan_friction;
    });
}

std::optional<LeaningColumn> columnOf(const State& state, std::size_t block, const Stand& stand,
                                      const SectionPlane& plane, const Vec3& acceleration) {
    if (!isOneFace(stand.base, plane) || (!stand.front.empty() && !isOneFace(stand.front, plane)))
        return std::nullopt;
    LeaningColumn column;
    column.pivot = farthest(stand.base, plane, stand.downhill);
    column.base_normal = stand.base_normal;
    column.downhill = stand.downhill;
    column.base_length = (column.pivot - farthest(stand.base, plane, -stand.downhill)).dot(stand.downhill);
    column.tan_friction = stand.base.front()->tan_friction;
    const Wrench other = blockForcesOn(state, block);
    const Vec3 force = state.blocks.mass[block] * acceleration + other.force;
    column.force = plane.in(force);
    const Vec2 arm = plane.in(state.blocks.position.get(block)) - column.pivot;
    column.arm = arm.norm();
    const double torque = other.torque.dot(plane.e1.cross(plane.e2));
    const double sense = turning(column, Vec2::UnitX(), Vec2::UnitY());
    column.moment = turning(column, arm, column.force) + sense * torque;
    if (!stand.front.empty()) {
        SideFace face;
        face.normal = plane.in(stand.front.front()->out);
        face.along = {-face.normal.y(), face.normal.x()};
        if (face.along.dot(column.base_normal) < 0) face.along = -face.along;
        face.top = farthest(stand.front, plane, face.along);
        face.bottom = farthest(stand.front, plane, -face.along);
        face.tan_friction = stand.front.front()->tan_friction;
        column.front = face;
    }
    return column;
}

/// Blocks from the toe up; nothing where they are no single row.
std::optional<std::vector<std::size_t>> rowOf(const std::vector<std::size_t>& free,
                                              const std::vector<Stand>& stands) {
    std::vector<std::size_t> row;
    for (const std::size_t block : free)
        if (stands[block].front.empty()) row.push_back(block);
    if (row.size() != 1) return std::nullopt;
    while (!stands[row.back()].behind.empty() && row.size() < free.size()) {
        const std::size_t behind = stands[row.back()].behind.front()->other;
        if (stands[behind].front.empty() || stands[behind].front.front()->other != row.back())
            return std::nullopt;
        row.push_back(behind);
    }
    return row.size() == free.size() ? std::optional(row) : std::nullopt;
}

double smallestSize(const State& state, const std::vector<std::size_t>& blocks) {
    double least = kInfinity;
    for (const std::size_t block : blocks) least = std::min(least, state.geometry->size[block]);
    return least;
}

}  // namespace

std::optional<ColumnRow> columnRow(State& state) {
    const std::vector<std::size_t> free = freeBlocks(state);
    if (free.size() < 2 || hasBoltsAtRest(state)) return std::nullopt;
    const auto touches = touchesOf(state);
    const auto plane = touches ? sectionOf(*touches) : std::nullopt;
    if (!plane || !haveOneWidth(*touches, plane->across, kSame * smallestSize(state, free)))
        return std::nullopt;
    state.load.gravity_share = state.load.water_share = 1;
    updateBlockForces(state);
    const Vec3 acceleration = bodyAcceleration(state);
    if (!plane->has(acceleration.normalized())) return std::nullopt;
    std::vector<Stand> stands(state.blocks.size());
    for (const std::size_t block : free) {
        auto stand = standOf(state, (*touches)[block], *plane, plane->in(acceleration));
        if (!stand) return std::nullopt;
        stands[block] = std::move(*stand);
    }
    const auto row = rowOf(free, stands);
    if (!row) return std::nullopt;
    ColumnRow found{{}, *row};
    for (const std::size_t block : *row) {
        const auto column = columnOf(state, block, stands[block], *plane, acceleration);
        if (!column) return std::nullopt;
        found.columns.push_back(*column);
    }
    return found;
}

}  // namespace talus::keyblocks
