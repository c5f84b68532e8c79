#include "stages/motion.h"

#include <cmath>

#include "stages/contacts.h"
#include "stages/motion_view.h"

namespace talus::stages {
namespace {

double opposing(double force, double velocity) {
    return velocity > 0 ? -std::abs(force) : velocity < 0 ? std::abs(force) : 0.0;
}

/// Cundall's local damping: a share of the out-of-balance force that opposes the motion, component by component.
Vec3 locallyDamped(const Vec3& force, const Vec3& velocity, double share) {
    Vec3 damped;
    for (int i = 0; i < 3; ++i) damped[i] = force[i] + share * opposing(force[i], velocity[i]);
    return damped;
}

}  // namespace

Vec3 gravity(const State& state) {
    const double g = state.geometry->model.gravity.magnitude * state.load.gravity_share;
    return {-g * std::sin(state.load.tilt), 0.0, -g * std::cos(state.load.tilt)};
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
    const auto wet_begin = incidence.wet_begin[block], wet_end = incidence.wet_begin[block + 1];
    if (wet_begin == wet_end) return sum;
    const Mat3 turn = state.blocks.orientation.matrix(block);
    for (auto k = wet_begin; k < wet_end; ++k) {
        const auto w = static_cast<std::size_t>(incidence.wet[static_cast<std::size_t>(k)]);
        sum.force += turn * state.wet.force.get(w);
        sum.torque += turn * state.wet.moment.get(w);
    }
    return sum;
}

void drift(State& state, Range range, double dt) {
    Blocks& blocks = state.blocks;
    const MotionView view{.force = constPointers(blocks.force),
                          .torque = constPointers(blocks.torque),
                          .inverse_inertia = constPointers(blocks.inverse_inertia),
                          .inverse_mass = blocks.inverse_mass.data(),
                          .free = blocks.free.data(),
                          .position = numbers(blocks.position),
                          .orientation = numbers(blocks.orientation),
                          .velocity = pointers(blocks.velocity),
                          .angular_momentum = pointers(blocks.angular_momentum),
                          .angular_velocity = pointers(blocks.angular_velocity),
                          .time_step = dt,
                          .decay = std::exp(-0.5 * dt * state.damping.mass),
                          .spin_decay = std::exp(-0.5 * dt * state.damping.rotation)};
    switch (state.instructions) {
        case simd::InstructionSet::avx512:
            return driftAvx512(view, range.begin, range.end);
        case simd::InstructionSet::avx2:
            return driftAvx2(view, range.begin, range.end);
        case simd::InstructionSet::scalar:
            return driftScalar(view, range.begin, range.end);
    }
}

void updateSpin(State& state, Range range) {
    for (std::size_t b = range.begin; b < range.end; ++b)
        state.blocks.angular_velocity.set(b, angularVelocity(state.blocks, b));
}

void gather(State& state, Range range, double dt) {
    Blocks& blocks = state.blocks;
    const double decay = std::exp(-0.5 * dt * state.damping.mass);
    const double spin_decay = std::exp(-0.5 * dt * state.damping.rotation);
    const Vec3 g = gravity(state);
    for (std::size_t b = range.begin; b < range.end; ++b) {
        if (blocks.motion[b] != Motion::free) continue;
        Wrench sum = outOfBalance(state, b, g);
        if (state.damping.local > 0) {
            sum.force = locallyDamped(sum.force, blocks.velocity.get(b), state.damping.local);
            sum.torque = locallyDamped(sum.torque, blocks.angular_velocity.get(b), state.damping.local);
        }
        blocks.force.set(b, sum.force);
        blocks.torque.set(b, sum.torque);
        blocks.velocity.set(
            b, decay * (blocks.velocity.get(b) + (0.5 * dt * blocks.inverse_mass[b]) * sum.force));
        blocks.angular_momentum.set(b, spin_decay * (blocks.angular_momentum.get(b) + 0.5 * dt * sum.torque));
    }
}

}  // namespace talus::stages
