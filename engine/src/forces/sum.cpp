#include "forces/sum.h"

#include <array>
#include <iterator>

#include "forces/bolts.h"
#include "forces/ground_motion.h"
#include "forces/loads.h"
#include "forces/phreatic.h"
#include "forces/seismic.h"
#include "forces/water.h"
#include "model/gravity.h"

namespace talus {
namespace {

std::vector<Error> makeWater(State& state, ForceParts&) { return buildWater(state); }
std::span<const std::int32_t> wetBlocksOf(const State& state, const ForceParts&) { return wetBlocks(state); }
Wrench waterOnBlock(const State& state, const ForceParts&, std::size_t block) {
    return waterOn(state, block);
}

constexpr TyingForce kBolts{bolts::ties, bolts::between, bolts::springsOn, bolts::storedEnergy, bolts::reach};

constexpr BlockForce kBlockForces[] = {
    {"water", makeWater, updateWater, drainWater, wetBlocksOf, waterOnBlock, nullptr, nullptr},
    {"phreatic surface", phreatic::build, phreatic::update, phreatic::drain, phreatic::blocks, phreatic::on,
     nullptr, nullptr},
    {"loads", loads::build, nullptr, nullptr, loads::blocks, loads::on, loads::dead, nullptr},
    {"bolts", bolts::build, bolts::update, nullptr, bolts::blocks, bolts::on, nullptr, &kBolts},
};

/// Adds up one number of each force that ties blocks.
template <class Number>
double sumOfTies(const Number& number) {
    double sum = 0;
    for (const BlockForce& force : kBlockForces)
        if (force.tying != nullptr) sum += number(*force.tying);
    return sum;
}

}  // namespace

std::span<const BlockForce> blockForces() { return kBlockForces; }

std::vector<Error> buildBlockForces(State& state) {
    state.force_parts.assign(std::size(kBlockForces), ForceParts{});
    std::vector<Error> errors;
    for (std::size_t k = 0; k < std::size(kBlockForces); ++k)
        for (Error& error : kBlockForces[k].build(state, state.force_parts[k]))
            errors.push_back(std::move(error));
    return errors;
}

void updateBlockForces(State& state) {
    for (const BlockForce& force : kBlockForces)
        if (force.update != nullptr) force.update(state);
}

void lookAtBlockForces(State& state) {
    for (const BlockForce& force : kBlockForces)
        if (force.look != nullptr) force.look(state);
}

Wrench blockForcesOn(const State& state, std::size_t block) {
    Wrench sum;
    eachBlockForce(state, [&](const BlockForce& force, const ForceParts& parts) {
        sum += force.on(state, parts, block);
    });
    return sum;
}

Wrench outsideForcesOn(const State& state, std::size_t block) {
    Wrench sum;
    eachBlockForce(state, [&](const BlockForce& force, const ForceParts& parts) {
        if (force.tying == nullptr) sum += force.on(state, parts, block);
    });
    return sum;
}

Wrench turningForcesOn(const State& state, std::size_t block) {
    Wrench sum;
    eachBlockForce(state, [&](const BlockForce& force, const ForceParts& parts) {
        if (force.dead == nullptr && force.tying == nullptr) sum += force.on(state, parts, block);
    });
    return sum;
}

DeadForce deadForcesOn(const State& state, std::size_t block) {
    DeadForce sum;
    eachBlockForce(state, [&](const BlockForce& force, const ForceParts& parts) {
        if (force.dead != nullptr) sum += force.dead(state, parts, block);
    });
    return sum;
}

bool hasDeadForces(const State& state) {
    bool any = false;
    eachBlockForce(state, [&](const BlockForce& force, const ForceParts& parts) {
        any = any || (force.dead != nullptr && !force.blocks(state, parts).empty());
    });
    return any;
}

bool hasBlockForces(const State& state) {
    bool any = false;
    eachBlockForce(state, [&](const BlockForce& force, const ForceParts& parts) {
        any = any || !force.blocks(state, parts).empty();
    });
    return any;
}

double tieEnergy(const State& state) {
    return sumOfTies([&](const TyingForce& force) { return force.storedEnergy(state); });
}

double tieReach(const State& state) {
    return sumOfTies([&](const TyingForce& force) { return force.reach(state); });
}

Vec3 bodyAcceleration(const State& state) {
    const Vec3 standing = standingAcceleration(state);
    return state.load.shaken ? Vec3(standing - groundAcceleration(state)) : standing;
}

Vec3 standingAcceleration(const State& state) {
    const Gravity& gravity = state.geometry->model.gravity;
    const Vec3 weight = gravity.magnitude * state.load.gravity_share * downward(gravity, state.load.tilt);
    const auto quake = seismicAcceleration(state);
    return quake ? Vec3(weight + *quake) : weight;
}

Wrench appliedOn(const State& state, std::size_t block, const Vec3& acceleration) {
    Wrench sum{state.blocks.mass[block] * acceleration, Vec3::Zero()};
    sum += outsideForcesOn(state, block);
    return sum;
}

Wrench outOfBalance(const State& state, std::size_t block, const Vec3& acceleration) {
    const Incidence& incidence = state.incidence;
    Wrench sum{state.blocks.mass[block] * acceleration, Vec3::Zero()};
    for (auto k = incidence.interface_begin[block]; k < incidence.interface_begin[block + 1]; ++k) {
        // Without branches: which side a block is on follows no pattern.
        const InterfaceWrench& wrench = state.interfaces.wrenches[incidence.slotOf(k)];
        const bool is_b = incidence.isB(k);
        sum.force += (is_b ? 1.0 : -1.0) * wrench.force;
        sum.torque += is_b ? wrench.moment_b : wrench.moment_a;
    }
    sum += blockForcesOn(state, block);
    return sum;
}

}  // namespace talus
