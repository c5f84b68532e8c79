#include "forces/sum.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "forces/bolts.h"
#include "forces/closed_water.h"
#include "forces/flow_water.h"
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

constexpr ForceMemory kWaterMemory{closedWaterMemory, rememberClosedWater};
constexpr ForceMemory kFlowMemory{flow_water::memory, flow_water::remember};
constexpr ForceMemory kPhreaticMemory{phreatic::memory, phreatic::remember};

constexpr TyingForce kBoltTies{bolts::ties,         bolts::between, bolts::springsOn,
                               bolts::storedEnergy, bolts::reach,   bolts::limits};
constexpr ForceMemory kBoltMemory{bolts::memory, bolts::remember};
constexpr SupportingForce kBoltsOneByOne{"bolts", bolts::reports, bolts::lines};

constexpr BlockForce kBlockForces[] = {
    {.name = "water",
     .build = makeWater,
     .blocks = wetBlocksOf,
     .on = waterOnBlock,
     .update = updateWater,
     .look = drainWater,
     .memory = &kWaterMemory},
    {.name = "phreatic",
     .build = phreatic::build,
     .blocks = phreatic::blocks,
     .on = phreatic::on,
     .update = phreatic::update,
     .look = phreatic::drain,
     .memory = &kPhreaticMemory},
    {.name = "flow",
     .build = flow_water::build,
     .blocks = flow_water::blocks,
     .on = flow_water::on,
     .memory = &kFlowMemory},
    {.name = "loads", .build = loads::build, .blocks = loads::blocks, .on = loads::on, .dead = loads::dead},
    {.name = "bolts",
     .build = bolts::build,
     .blocks = bolts::blocks,
     .on = bolts::on,
     .update = bolts::update,
     .tying = &kBoltTies,
     .memory = &kBoltMemory,
     .supporting = &kBoltsOneByOne},
};

/// Sums one number over the forces that tie blocks.
template <class Number>
double sumOfTies(const Number& number) {
    double sum = 0;
    for (const BlockForce& force : kBlockForces)
        if (force.tying != nullptr) sum += number(*force.tying);
    return sum;
}

/// The public name of a force's array.
std::string fullName(const BlockForce& force, const ForceArray& array) {
    return std::string(force.name) + "." + array.name;
}

void append(SupportLines& all, const SupportLines& more) {
    if (all.point_begin.empty()) all.point_begin = {0};
    const std::int32_t before = all.point_begin.back();
    all.name.insert(all.name.end(), more.name.begin(), more.name.end());
    for (std::size_t k = 1; k < more.point_begin.size(); ++k)
        all.point_begin.push_back(before + more.point_begin[k]);
    for (std::size_t p = 0; p < more.block.size(); ++p)
        all.add(more.block[p], Vec3(more.point.x[p], more.point.y[p], more.point.z[p]));
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

Result<std::vector<TieLimit>> tieLimits(const State& state) {
    std::vector<TieLimit> all;
    for (const BlockForce& force : kBlockForces) {
        if (force.tying == nullptr) continue;
        const auto limits = force.tying->limits(state);
        if (!limits.ok()) return limits.errors();
        all.insert(all.end(), limits->begin(), limits->end());
    }
    return all;
}

std::vector<ForceArray> forceMemory(const State& state) {
    std::vector<ForceArray> all;
    for (const BlockForce& force : kBlockForces) {
        if (force.memory == nullptr) continue;
        for (ForceArray& array : force.memory->read(state))
            all.push_back({fullName(force, array), std::move(array.values)});
    }
    return all;
}

bool isForceMemory(const State& state, const std::vector<ForceArray>& memory) {
    const auto fits = [](const ForceArray& own, const ForceArray& given) {
        return own.name == given.name && own.values.size() == given.values.size() &&
               std::all_of(given.values.begin(), given.values.end(),
                           [](double value) { return std::isfinite(value); });
    };
    const std::vector<ForceArray> own = forceMemory(state);
    return std::equal(own.begin(), own.end(), memory.begin(), memory.end(), fits);
}

void setForceMemory(State& state, const std::vector<ForceArray>& memory) {
    std::span<const ForceArray> left = memory;
    for (const BlockForce& force : kBlockForces) {
        if (force.memory == nullptr) continue;
        const std::size_t count = force.memory->read(state).size();
        force.memory->write(state, left.first(count));
        left = left.subspan(count);
    }
}

std::vector<Supports> supportReports(const State& state) {
    std::vector<Supports> all;
    for (const BlockForce& force : kBlockForces)
        if (force.supporting != nullptr)
            all.push_back({force.supporting->kind, force.supporting->reports(state)});
    return all;
}

SupportLines supportLines(const State& state) {
    SupportLines all;
    for (const BlockForce& force : kBlockForces)
        if (force.supporting != nullptr) append(all, force.supporting->lines(state));
    return all;
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
