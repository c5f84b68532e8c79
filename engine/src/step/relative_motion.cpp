#include "step/relative_motion.h"

#include <cassert>
#include <cmath>

#include "forces/contact_forces.h"
#include "state/block_motion.h"
#include "state/point_layout.h"

namespace talus {
namespace {

/// Change of the velocity of a block at a place along a direction per impulse along it [1/kg].
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

}  // namespace

DeepestPoint deepestPoint(const State& state, std::size_t i) {
    const RelativePose pose = relativePose(state, i);
    DeepestPoint deepest{Vec3::Zero(), -kInfinity};
    for (const Eigen::Vector2d& v : patchOutline(state.interfaces, i)) {
        const double depth = -(pose.gap.x() + v.x() * pose.gap.y() + v.y() * pose.gap.z());
        if (depth > deepest.depth) deepest = {pose.origin + v.x() * pose.e1 + v.y() * pose.e2, depth};
    }
    return deepest;
}

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

// An impulse J slows the relative motion to v - wJ and takes vJ - wJ^2/2.
void takeEnergy(State& state, std::size_t i, const Vec3& place, const RelativeMotion& motion, double energy) {
    assert(energy >= 0 && energy < motion.energy());
    const double share = energy / motion.energy();
    const Vec3 impulse =
        -(motion.speed / motion.mobility) * (share / (1.0 + std::sqrt(1.0 - share))) * motion.direction;
    push(state.blocks, static_cast<std::size_t>(state.interfaces.block_b[i]), place, impulse);
    push(state.blocks, static_cast<std::size_t>(state.interfaces.block_a[i]), place, -impulse);
}

}  // namespace talus
