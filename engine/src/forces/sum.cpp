#include "forces/sum.h"

#include <cmath>

#include "forces/water.h"

namespace talus {

const std::array<BlockForce, 1> kBlockForces{{
    {"water", updateWater, wetBlocks, waterOn},
}};

void updateBlockForces(State& state) {
    for (const BlockForce& force : kBlockForces) force.update(state);
}

Vec3 gravity(const State& state) {
    const double g = state.geometry->model.gravity.magnitude * state.load.gravity_share;
    return {-g * std::sin(state.load.tilt), 0.0, -g * std::cos(state.load.tilt)};
}

Wrench appliedOn(const State& state, std::size_t block, const Vec3& gravity) {
    Wrench sum{state.blocks.mass[block] * gravity, Vec3::Zero()};
    for (const BlockForce& force : kBlockForces) sum += force.on(state, block);
    return sum;
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
    for (const BlockForce& force : kBlockForces) sum += force.on(state, block);
    return sum;
}

}  // namespace talus
