#include "step/motion.h"

#include <algorithm>
#include <cmath>

#include "forces/sum.h"
#include "state/block_motion.h"
#include "step/motion_view.h"

namespace talus {
namespace {

MotionView motionView(State& state, double dt) {
    Blocks& blocks = state.blocks;
    const Vec3 g = bodyAcceleration(state);
    return {.interface_begin = state.incidence.interface_begin.data(),
            .mass = blocks.mass.data(),
            .inverse_mass = blocks.inverse_mass.data(),
            .free = blocks.free.data(),
            .inverse_inertia = constPointers(blocks.inverse_inertia),
            .wrench = state.incidence.wrench.data(),
            .wrenches = reinterpret_cast<const double*>(state.interfaces.wrenches.data()),
            .position = numbers(blocks.position),
            .orientation = numbers(blocks.orientation),
            .velocity = pointers(blocks.velocity),
            .angular_momentum = pointers(blocks.angular_momentum),
            .force = pointers(blocks.force),
            .torque = pointers(blocks.torque),
            .angular_velocity = pointers(blocks.angular_velocity),
            .gravity = {g.x(), g.y(), g.z()},
            .time_step = dt,
            .decay = std::exp(-0.5 * dt * state.damping.mass),
            .spin_decay = std::exp(-0.5 * dt * state.damping.rotation),
            .local_damping = state.damping.local};
}

const MotionKernels& kernels(const State& state) {
    return simd::buildFor(state.instructions, kMotionScalar, kMotionAvx2, kMotionAvx512);
}

/// All forces on blocks, into force and torque.
void sumForces(State& state, const MotionView& view, Range range) {
    Blocks& blocks = state.blocks;
    kernels(state).sum_wrenches(view, range.begin, range.end);
    eachBlockForce(state, [&](const BlockForce& force, const ForceParts& parts) {
        const std::span<const std::int32_t> on = force.blocks(state, parts);
        for (auto next = std::lower_bound(on.begin(), on.end(), static_cast<std::int32_t>(range.begin));
             next != on.end() && static_cast<std::size_t>(*next) < range.end; ++next) {
            const auto b = static_cast<std::size_t>(*next);
            if (blocks.motion[b] != Motion::free) continue;
            const Wrench wrench = force.on(state, parts, b);
            blocks.force.set(b, blocks.force.get(b) + wrench.force);
            blocks.torque.set(b, blocks.torque.get(b) + wrench.torque);
        }
    });
}

}  // namespace

void drift(State& state, Range range, double dt) {
    kernels(state).drift(motionView(state, dt), range.begin, range.end);
}

void gather(State& state, Range range, double dt) {
    const MotionView view = motionView(state, dt);
    sumForces(state, view, range);
    kernels(state).kick(view, range.begin, range.end);
}

void gatherAndDrift(State& state, Range range, double dt) {
    // Blocks per piece: those loaded by the first pass are still in the second-level cache for the other.
    constexpr std::size_t kBlocksAtOnce = 512;
    const MotionView view = motionView(state, dt);
    for (std::size_t begin = range.begin; begin < range.end; begin += kBlocksAtOnce) {
        const Range piece{begin, std::min(begin + kBlocksAtOnce, range.end)};
        sumForces(state, view, piece);
        kernels(state).kick_and_drift(view, piece.begin, piece.end);
    }
}

}  // namespace talus
