#include "contacts/gap_recovery.h"

#include <algorithm>
#include <cmath>

#include "contacts/limits.h"
#include "forces/contact_forces.h"
#include "state/block_motion.h"
#include "state/incidence.h"

namespace talus {
namespace {

constexpr double kShare =
    0.02;  // of the energy of the relative motion, per look: far less than an impact would feel

/// How far the reference gap is from where the faces are [m].
double gapToRecover(const State& state, std::size_t i) {
    const Interfaces& f = state.interfaces;
    const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
    return -f.referenceGap(i, 0) - kClosedGap * std::min(state.geometry->size[a], state.geometry->size[b]);
}

/// The deepest contact point of an interface.
struct Deepest {
    Vec3 place = Vec3::Zero();  ///< [m]
    double depth = 0;           ///< of its spring, negative when open [m]
};

Deepest deepestPoint(const State& state, std::size_t i) {
    const RelativePose pose = relativePose(state, i);
    Deepest deepest{Vec3::Zero(), -kInfinity};
    for (const Eigen::Vector2d& v : patchOutline(state.interfaces, i)) {
        const double depth = -(pose.gap.x() + v.x() * pose.gap.y() + v.y() * pose.gap.z());
        if (depth > deepest.depth) deepest = {pose.origin + v.x() * pose.e1 + v.y() * pose.e2, depth};
    }
    return deepest;
}

/// Change of that velocity along a direction per impulse along it [1/kg].
double mobility(const Blocks& blocks, std::size_t b, const Vec3& place, const Vec3& direction) {
    const Vec3 lever =
        blocks.orientation.matrix(b).transpose() * (place - blocks.position.get(b)).cross(direction);
    return blocks.inverse_mass[b] + lever.dot(blocks.inverse_inertia.get(b).cwiseProduct(lever));
}

void push(Blocks& blocks, std::size_t b, const Vec3& place, const Vec3& impulse) {
    if (blocks.motion[b] != Motion::free) return;
    blocks.velocity.set(b, blocks.velocity.get(b) + blocks.inverse_mass[b] * impulse);
    blocks.angular_momentum.set(
        b, blocks.angular_momentum.get(b) + (place - blocks.position.get(b)).cross(impulse));
}

/// How two blocks move against each other at a place.
struct RelativeMotion {
    Vec3 direction = Vec3::Zero();
    double speed = 0;     ///< of b over a [m/s]
    double mobility = 0;  ///< change of that per impulse along it [1/kg]

    /// What an impulse can take of it at most [J].
    double energy() const { return mobility > 0 ? 0.5 * speed * speed / mobility : 0.0; }
};

RelativeMotion motionAt(const State& state, std::size_t i, const Vec3& place) {
    const Blocks& blocks = state.blocks;
    const auto a = static_cast<std::size_t>(state.interfaces.block_a[i]),
               b = static_cast<std::size_t>(state.interfaces.block_b[i]);
    const Vec3 velocity = velocityAt(blocks, b, place) - velocityAt(blocks, a, place);
    const double speed = velocity.norm();
    if (!(speed > 0)) return {};
    const Vec3 direction = velocity / speed;
    return {direction, speed, mobility(blocks, a, place, direction) + mobility(blocks, b, place, direction)};
}

/// An impulse J slows the relative motion to v - wJ and takes vJ - wJ^2/2. \pre energy < motion.energy()
void takeEnergy(State& state, std::size_t i, const Vec3& place, const RelativeMotion& motion, double energy) {
    const double share = energy / motion.energy();
    const Vec3 impulse =
        -(motion.speed / motion.mobility) * (share / (1.0 + std::sqrt(1.0 - share))) * motion.direction;
    push(state.blocks, static_cast<std::size_t>(state.interfaces.block_b[i]), place, impulse);
    push(state.blocks, static_cast<std::size_t>(state.interfaces.block_a[i]), place, -impulse);
}

double energyOf(const State& state, std::size_t i) {
    const contact::JointLaw& law = state.laws[static_cast<std::size_t>(state.interfaces.joint[i])];
    double sum = 0;
    for (const ContactPoint& point : contactPoints(state, i))
        sum += contact::storedEnergy(law, point.area, point.force);
    return sum;
}

/// Raising the reference gap by o presses every spring by o more; together they hold no more than k A (depth o + o^2/2)
/// more, with the depth of the deepest. As far as that one is open it costs nothing. The blocks pay for what the springs
/// then do hold more. \return whether anything changed
bool recoverGap(State& state, std::size_t i, double missing) {
    const Deepest deepest = deepestPoint(state, i);
    const double depth = std::max(0.0, deepest.depth),
                 open = std::min(missing, std::max(0.0, -deepest.depth));
    const contact::JointLaw& law = state.laws[static_cast<std::size_t>(state.interfaces.joint[i])];
    const RelativeMotion motion = motionAt(state, i, deepest.place);
    const double paid = contact::pressedBy(law, state.interfaces.area[i], depth, kShare * motion.energy());
    const double step = open + std::min(missing - open, paid);
    if (!(step > 0)) return false;
    const double before = energyOf(state, i);
    state.interfaces.referenceGap(i, 0) += step;
    if (const double cost = energyOf(state, i) - before; cost > 0)
        takeEnergy(state, i, deepest.place, motion, cost);
    return true;
}

/// Whether there was a search since the first: before it no pair of faces has a gap to recover.
bool searchedAgain(const State& state) {
    const PositionArray &first = state.geometry->initial_position, &last = state.search_position;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        if (first.get(b) != last.get(b)) return true;
    return false;
}

}  // namespace

bool recoverGaps(State& state) {
    bool changes = false;
    const bool faces_too = searchedAgain(state);
    for (const InterfaceGroup& group : state.interfaces.groups) {
        if (!isVertexEdge(state.interfaces, static_cast<std::size_t>(group.begin)) && !faces_too) continue;
        for (std::int32_t k = 0; k < group.size; ++k) {
            const auto i = static_cast<std::size_t>(group.begin + k);
            if (isIdle(state.interfaces, i)) continue;
            if (const double missing = gapToRecover(state, i); missing > 0)
                changes = recoverGap(state, i, missing) || changes;
        }
    }
    return changes;
}

}  // namespace talus
