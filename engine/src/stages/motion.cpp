#include "stages/motion.h"

#include <algorithm>
#include <cmath>

#include "stages/contacts.h"
#include "stages/motion_view.h"

namespace talus::stages {
namespace {

MotionView motionView(State& state, double dt) {
    Blocks& blocks = state.blocks;
    const Vec3 g = gravity(state);
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

/// Weight, interfaces and water, into force and torque.
void sumForces(State& state, const MotionView& view, Range range) {
    Blocks& blocks = state.blocks;
    kernels(state).sum_wrenches(view, range.begin, range.end);
    const std::vector<std::int32_t>& wet = state.incidence.wet_blocks;
    for (auto next = std::lower_bound(wet.begin(), wet.end(), static_cast<std::int32_t>(range.begin));
         next != wet.end() && static_cast<std::size_t>(*next) < range.end; ++next) {
        const auto b = static_cast<std::size_t>(*next);
        if (blocks.motion[b] != Motion::free) continue;
        const Wrench water = waterOn(state, b);
        blocks.force.set(b, blocks.force.get(b) + water.force);
        blocks.torque.set(b, blocks.torque.get(b) + water.torque);
    }
}

}  // namespace

Vec3 gravity(const State& state) {
    const double g = state.geometry->model.gravity.magnitude * state.load.gravity_share;
    return {-g * std::sin(state.load.tilt), 0.0, -g * std::cos(state.load.tilt)};
}

Wrench waterOn(const State& state, std::size_t block) {
    const Incidence& incidence = state.incidence;
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  // in the block's own frame
    for (auto k = incidence.wet_begin[block]; k < incidence.wet_begin[block + 1]; ++k) {
        const auto w = static_cast<std::size_t>(incidence.wet[static_cast<std::size_t>(k)]);
        force += state.wet.force.get(w);
        moment += state.wet.moment.get(w);
    }
    const Mat3 turn = state.blocks.orientation.matrix(block);
    return {turn * force, turn * moment};
}

Wrench outOfBalance(const State& state, std::size_t block, const Vec3& gravity) {
    const Incidence& incidence = state.incidence;
    Wrench sum{state.blocks.mass[block] * gravity, Vec3::Zero()};
    for (auto k = incidence.interface_begin[block]; k < incidence.interface_begin[block + 1]; ++k) {
        // Without branches: which side a block is on follows no pattern.
        const InterfaceWrench& wrench = state.interfaces.wrenches[incidence.slotOf(k)];
        const bool is_b = incidence.isB(k);
        sum.force += (is_b ? 1.0 : -1.0) * wrench.force;
        sum.torque += is_b ? wrench.moment_b : wrench.moment_a;
    }
    if (incidence.wet_begin[block] == incidence.wet_begin[block + 1]) return sum;
    const Wrench water = waterOn(state, block);
    sum.force += water.force;
    sum.torque += water.torque;
    return sum;
}

void drift(State& state, Range range, double dt) {
    kernels(state).drift(motionView(state, dt), range.begin, range.end);
}

void updateSpin(State& state, Range range) {
    for (std::size_t b = range.begin; b < range.end; ++b)
        state.blocks.angular_velocity.set(b, angularVelocity(state.blocks, b));
}

void gather(State& state, Range range, double dt) {
    const MotionView view = motionView(state, dt);
    sumForces(state, view, range);
    kernels(state).kick(view, range.begin, range.end);
}

void gatherAndDrift(State& state, Range range, double dt) {
    // Blocks: what the first pass brought in is still in the second cache for the other.
    constexpr std::size_t kPiece = 512;
    const MotionView view = motionView(state, dt);
    for (std::size_t begin = range.begin; begin < range.end; begin += kPiece) {
        const Range piece{begin, std::min(begin + kPiece, range.end)};
        sumForces(state, view, piece);
        kernels(state).kick_and_drift(view, piece.begin, piece.end);
    }
}

}  // namespace talus::stages
