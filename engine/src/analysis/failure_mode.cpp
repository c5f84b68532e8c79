#include "analysis/failure_mode.h"

#include <algorithm>
#include <cmath>

#include "contacts/update.h"
#include "forces/contact_forces.h"
#include "measure/measure.h"
#include "state/block_motion.h"
#include "state/incidence.h"
#include "step/step.h"
#include "step/time_step.h"
#include "talus/motion_roles.h"

namespace talus::analysis {
namespace {

constexpr double kDashpot = 0.5;  // damping ratio of the fastest mode: takes out the rattle only
// The motion is looked at when it has gone these many times the deflection at rest, doubling, until two looks agree on a
// pure mode: close to toppling, elastic rocking takes part in a slide at first and is left behind by it.
constexpr double kFirstTarget = 10.0, kLastTarget = 640.0;
constexpr double kLeastMotion = 5.0;  // of the deflection at rest, else it is no failure
constexpr int kStepsPerLook = 20;
constexpr std::int64_t kMostSteps = 400'000;
constexpr std::int64_t kStepsPerRestCheck = 20'000;
constexpr double kAtRest = 1e-3;  // of the largest kinetic energy seen: the motion has come to rest

struct Poses {
    PositionArray position;
    QuaternionArray orientation;
};

BlockWay waySince(const State& state, const Poses& start, std::size_t b) {
    return {.free = state.blocks.motion[b] == Motion::free,
            .position = state.blocks.position.get(b),
            .radius = state.geometry->radius[b],
            .translation = (state.blocks.position.get(b) - start.position.get(b)).norm(),
            .rotation = stages::rotationFrom(start.orientation, state.blocks.orientation, b),
            .mass = state.blocks.mass[b]};
}

double largestMotion(const State& state, const Poses& start) {
    double largest = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        if (state.blocks.motion[b] == Motion::free)
            largest = std::max(largest, waySince(state, start, b).way());
    return largest;
}

/// True inertia, at rest, with dashpots that only take out the rattle. Returns the time step [s].
double makeDynamic(State& state, bool parallel) {
    setInertia(state, std::vector<double>(state.blocks.size(), 1.0));
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        state.blocks.velocity.set(b, Vec3::Zero());
        state.blocks.angular_momentum.set(b, Vec3::Zero());
    }
    const std::vector<double> bounds = stages::frequencyBounds(state, parallel);
    const double bound = *std::max_element(bounds.begin(), bounds.end());
    const double omega_squared = bound > 0 ? bound : 1.0;
    state.damping = {.contact = 2.0 * kDashpot / std::sqrt(omega_squared)};
    state.release = 1.0;
    stages::updateForces(state, parallel);
    return kContinuationStepSafety * stages::stableTimeStep(omega_squared, state.damping.contact);
}

/// Shares of open area and of mobilised friction over a block's Lps.
void addContactEvidence(const State& state, std::size_t block, BlockMotion& motion) {
    double area = 0, open_area = 0, shear = 0, strength = 0;
    for (auto k = state.incidence.interface_begin[block]; k < state.incidence.interface_begin[block + 1];
         ++k) {
        const auto i = static_cast<std::size_t>(state.incidence.interface[static_cast<std::size_t>(k)]);
        if (stages::isIdle(state.interfaces, i)) continue;
        const contact::JointLaw& law = state.laws[static_cast<std::size_t>(state.interfaces.joint[i])];
        for (const stages::PointState& point : stages::pointStates(state, i)) {
            area += point.area;
            if (point.force.normal == 0.0) {
                open_area += point.area;
                continue;
            }
            shear += std::hypot(point.force.shear_1, point.force.shear_2);
            strength += contact::shearStrength(law, point.area, point.force.normal, point.memory.bond);
        }
    }
    motion.open_share = area > 0 ? open_area / area : 1.0;
    motion.mobilised_friction = strength > 0 ? std::min(1.0, shear / strength) : 0.0;
}

BlockMotion describeBlock(const State& state, const Poses& start, std::size_t b, const BlockWay& way,
                          FailureMode role) {
    BlockMotion motion;
    motion.block = state.geometry->model.blocks[b].name;
    motion.mode = role;
    motion.moving = role != FailureMode::none;
    motion.translation = state.blocks.position.get(b) - start.position.get(b);
    motion.rotation = way.rotation;
    motion.rotation_share = way.way() > 0 ? way.rotation * way.radius / way.way() : 0.0;
    addContactEvidence(state, b, motion);
    return motion;
}

void describeFailure(const State& state, const Poses& start, double deflection, Failure& failure) {
    failure.motions.clear();
    failure.moving_blocks.clear();
    std::vector<BlockWay> ways;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) ways.push_back(waySince(state, start, b));
    const std::vector<FailureMode> roles = motionRoles(ways, deflection);
    for (std::size_t b = 0; b < ways.size(); ++b) {
        if (!ways[b].free) continue;
        failure.motions.push_back(describeBlock(state, start, b, ways[b], roles[b]));
        if (failure.motions.back().moving) failure.moving_blocks.push_back(failure.motions.back().block);
    }
    std::sort(failure.moving_blocks.begin(), failure.moving_blocks.end());
    failure.mode = overallMode(ways, roles);
}

}  // namespace

Failure continueFailure(State& state, double deflection, const Control& control, bool parallel) {
    Failure failure;
    failure.time_step = makeDynamic(state, parallel);
    const Poses start{state.blocks.position, state.blocks.orientation};
    double most_energy = 0;
    bool clear = false;
    for (double target = kFirstTarget; target <= kLastTarget && !clear && !failure.at_rest; target *= 2) {
        while (failure.motion < target * deflection && failure.steps < kMostSteps && !failure.at_rest) {
            if (control.stop != nullptr && control.stop->load(std::memory_order_relaxed)) break;
            stages::advance(state, {failure.time_step, parallel}, kStepsPerLook);
            failure.steps += kStepsPerLook;
            stages::refreshInterfaces(state, parallel, kStepsPerLook * failure.time_step);
            failure.motion = largestMotion(state, start);
            if (failure.steps % kStepsPerRestCheck == 0)
                failure.at_rest = stages::kineticEnergy(state) < kAtRest * most_energy;
            most_energy = std::max(most_energy, stages::kineticEnergy(state));
        }
        if (failure.motion < target * deflection) break;  // out of steps, interrupted or at rest
        Failure now = failure;
        describeFailure(state, start, deflection, now);
        clear = now.mode == failure.mode && now.mode != FailureMode::mixed &&
                now.moving_blocks == failure.moving_blocks;
        failure = std::move(now);
    }
    failure.confirmed = failure.motion >= kLeastMotion * deflection;
    failure.seconds = static_cast<double>(failure.steps) * failure.time_step;
    describeFailure(state, start, deflection, failure);
    return failure;
}

}  // namespace talus::analysis
