#include "stages/motion.h"

#include <cmath>

#include "stages/contacts.h"
#include "stages/motion_view.h"

namespace talus::stages {
namespace {

bool isWet(const Incidence& incidence, std::size_t block) {
    return incidence.wet_begin[block] != incidence.wet_begin[block + 1];
}

/// Adds what the water does to a block.
void addWater(const State& state, std::size_t block, Wrench& sum) {
    const Incidence& incidence = state.incidence;
    const Mat3 turn = state.blocks.orientation.matrix(block);
    for (auto k = incidence.wet_begin[block]; k < incidence.wet_begin[block + 1]; ++k) {
        const auto w = static_cast<std::size_t>(incidence.wet[static_cast<std::size_t>(k)]);
        sum.force += turn * state.wet.force.get(w);
        sum.torque += turn * state.wet.moment.get(w);
    }
}

GatherView gatherView(State& state, double dt) {
    Blocks& blocks = state.blocks;
    const Vec3 g = gravity(state);
    return {.interface_begin = state.incidence.interface_begin.data(),
            .mass = blocks.mass.data(),
            .inverse_mass = blocks.inverse_mass.data(),
            .free = blocks.free.data(),
            .angular_velocity = constPointers(blocks.angular_velocity),
            .wrench = state.incidence.wrench.data(),
            .wrenches = reinterpret_cast<const double*>(state.interfaces.wrenches.data()),
            .velocity = pointers(blocks.velocity),
            .angular_momentum = pointers(blocks.angular_momentum),
            .force = pointers(blocks.force),
            .torque = pointers(blocks.torque),
            .gravity = {g.x(), g.y(), g.z()},
            .time_step = dt,
            .decay = std::exp(-0.5 * dt * state.damping.mass),
            .spin_decay = std::exp(-0.5 * dt * state.damping.rotation),
            .local_damping = state.damping.local};
}

void sumWrenches(const State& state, const GatherView& view, Range range) {
    switch (state.instructions) {
        case simd::InstructionSet::avx512:
            return sumWrenchesAvx512(view, range.begin, range.end);
        case simd::InstructionSet::avx2:
            return sumWrenchesAvx2(view, range.begin, range.end);
        case simd::InstructionSet::scalar:
            return sumWrenchesScalar(view, range.begin, range.end);
    }
}

void kick(const State& state, const GatherView& view, Range range) {
    switch (state.instructions) {
        case simd::InstructionSet::avx512:
            return kickAvx512(view, range.begin, range.end);
        case simd::InstructionSet::avx2:
            return kickAvx2(view, range.begin, range.end);
        case simd::InstructionSet::scalar:
            return kickScalar(view, range.begin, range.end);
    }
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
    if (isWet(incidence, block)) addWater(state, block, sum);
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
    const GatherView view = gatherView(state, dt);
    sumWrenches(state, view, range);
    for (std::size_t b = range.begin; b < range.end; ++b) {
        if (!isWet(state.incidence, b) || blocks.motion[b] != Motion::free) continue;
        Wrench sum{blocks.force.get(b), blocks.torque.get(b)};
        addWater(state, b, sum);
        blocks.force.set(b, sum.force);
        blocks.torque.set(b, sum.torque);
    }
    kick(state, view, range);
}

}  // namespace talus::stages
