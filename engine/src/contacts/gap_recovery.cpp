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

/// Takes up to `energy` [J] of what the two blocks have in relative motion at a place, at most kShare of it.
/// \return what it took [J]
double takeEnergy(State& state, std::size_t i, const Vec3& place, double energy) {
    Blocks& blocks = state.blocks;
    const auto a = static_cast<std::size_t>(state.interfaces.block_a[i]),
               b = static_cast<std::size_t>(state.interfaces.block_b[i]);
    const Vec3 velocity = velocityAt(blocks, b, place) - velocityAt(blocks, a, place);
    const double speed = velocity.norm();
    if (!(speed > 0)) return 0;
    const Vec3 direction = velocity / speed;
    const double weight = mobility(blocks, a, place, direction) + mobility(blocks, b, place, direction);
    if (!(weight > 0)) return 0;
    // An impulse J slows the relative motion to v - wJ and takes vJ - wJ^2/2, at most v^2/(2w).
    const double most = 0.5 * speed * speed / weight, taken = std::min(energy, kShare * most);
    const Vec3 impulse = -(speed / weight) * (1.0 - std::sqrt(1.0 - taken / most)) * direction;
    push(blocks, b, place, impulse);
    push(blocks, a, place, -impulse);
    return taken;
}

/// Raising the reference gap by o presses every spring by o more; together they hold no more than k A (depth o + o^2/2)
/// more, with the depth of the deepest. As far as that one is open it costs nothing.
void recoverGap(State& state, std::size_t i, double missing) {
    const Deepest deepest = deepestPoint(state, i);
    const double depth = std::max(0.0, deepest.depth),
                 open = std::min(missing, std::max(0.0, -deepest.depth));
    const contact::JointLaw& law = state.laws[static_cast<std::size_t>(state.interfaces.joint[i])];
    const double area = state.interfaces.area[i];
    const double rest = missing - open;
    const double energy = takeEnergy(state, i, deepest.place, contact::energyToPress(law, area, depth, rest));
    const double paid = contact::pressedBy(law, area, depth, energy);
    state.interfaces.referenceGap(i, 0) += open + std::min(rest, paid);
}

/// Whether there was a search since the first: before it no pair of faces has a gap to recover.
bool searchedAgain(const State& state) {
    const PositionArray &first = state.geometry->initial_position, &last = state.search_position;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        if (first.get(b) != last.get(b)) return true;
    return false;
}

}  // namespace

void recoverGaps(State& state) {
    const bool faces_too = searchedAgain(state);
    for (const InterfaceGroup& group : state.interfaces.groups) {
        if (!isVertexEdge(state.interfaces, static_cast<std::size_t>(group.begin)) && !faces_too) continue;
        for (std::int32_t k = 0; k < group.size; ++k) {
            const auto i = static_cast<std::size_t>(group.begin + k);
            if (isIdle(state.interfaces, i)) continue;
            if (const double missing = gapToRecover(state, i); missing > 0) recoverGap(state, i, missing);
        }
    }
}

}  // namespace talus
