#include "failure/failure.h"

#include <algorithm>
#include <cmath>

#include "forces/contact_forces.h"
#include "measure/natural_order.h"
#include "state/block_motion.h"
#include "state/incidence.h"
#include "step/time_step.h"
#include "talus/motion_roles.h"

namespace talus::failure {
namespace {

// Share of the mass that may be added as inertia when a failure is continued: its accelerations are true to 1
// %.
constexpr double kAddedInertia = 0.01;
constexpr double kDashpot = 0.5;  // damping ratio of the fastest mode: damps chatter only

struct Places {
    const PositionArray& position;
    const QuaternionArray& orientation;
};

/// The normal of the joint that carries most of a block; none: nothing carries it.
Vec3 carryingNormal(const State& state, std::size_t b) {
    Vec3 normal = Vec3::Zero();
    double most = 0;
    for (auto k = state.incidence.interface_begin[b]; k < state.incidence.interface_begin[b + 1]; ++k) {
        const auto i = static_cast<std::size_t>(state.incidence.interface[static_cast<std::size_t>(k)]);
        if (isIdle(state.interfaces, i)) continue;
        double force = 0;
        for (const ContactPoint& point : contactPoints(state, i)) force += point.force.normal;
        if (force > most) most = force, normal = relativePose(state, i).e3;
    }
    return normal;
}

/// Least displacement of a block against another at any of their contact points [m]: zero at a pivot. 0 where
/// it touches none.
double leastAgainstOthers(const Places& from, const State& to, std::size_t b) {
    double least = kInfinity;
    for (auto k = to.incidence.interface_begin[b]; k < to.incidence.interface_begin[b + 1]; ++k) {
        const auto i = static_cast<std::size_t>(to.incidence.interface[static_cast<std::size_t>(k)]);
        if (isVertexEdge(to.interfaces, i) && isIdle(to.interfaces, i)) continue;
        const RelativePose was = relativePose(from.position, from.orientation, to.interfaces, i),
                           is = relativePose(to, i);
        for (const ContactPoint& point : contactPoints(to, i)) {
            const Vec3 at(1, point.position.x(), point.position.y());
            least = std::min(least, Vec3((is.slide_1 - was.slide_1).dot(at),
                                         (is.slide_2 - was.slide_2).dot(at), (is.gap - was.gap).dot(at))
                                        .norm());
        }
    }
    return least < kInfinity ? least : 0;
}

BlockDisplacement displacementOf(const Places& from, const State& to, std::size_t b) {
    return {.free = to.blocks.motion[b] == Motion::free,
            .position = to.blocks.position.get(b),
            .radius = to.geometry->radius[b],
            .translation = (to.blocks.position.get(b) - from.position.get(b)).norm(),
            .rotation = rotationFrom(from.orientation, to.blocks.orientation, b),
            .spin = std::abs(
                rotationVector(from.orientation[b], to.blocks.orientation[b]).dot(carryingNormal(to, b))),
            .mass = to.blocks.mass[b],
            .least_against_others = leastAgainstOthers(from, to, b)};
}

/// Shares of open area and of mobilised friction over a block's contact points.
void addContactEvidence(const State& state, std::size_t block, BlockMotion& motion) {
    double area = 0, open_area = 0, shear = 0, strength = 0;
    for (auto k = state.incidence.interface_begin[block]; k < state.incidence.interface_begin[block + 1];
         ++k) {
        const auto i = static_cast<std::size_t>(state.incidence.interface[static_cast<std::size_t>(k)]);
        if (isIdle(state.interfaces, i)) continue;
        const contact::JointLaw& law = state.laws[static_cast<std::size_t>(state.interfaces.joint[i])];
        for (const ContactPoint& point : contactPoints(state, i)) {
            area += point.area;
            if (point.force.normal == 0.0) {
                open_area += point.area;
                continue;
            }
            shear += std::hypot(point.force.shear_1, point.force.shear_2);
            strength += contact::shearStrength(law, point.area, point.force.normal, point.memory.bond,
                                               point.cohesive);
        }
    }
    motion.open_share = area > 0 ? open_area / area : 1.0;
    motion.mobilised_friction = strength > 0 ? std::min(1.0, shear / strength) : 0.0;
}

BlockMotion describeBlock(const Places& from, const State& to, std::size_t b, const BlockDisplacement& moved,
                          FailureMode role) {
    BlockMotion motion;
    motion.block = to.geometry->model.blocks[b].name;
    motion.mode = role;
    motion.moving = role != FailureMode::none;
    motion.translation = to.blocks.position.get(b) - from.position.get(b);
    motion.rotation = moved.rotation;
    motion.turn = rotationVector(from.orientation[b], to.blocks.orientation[b]);
    motion.rotation_share =
        moved.ofFarthestCorner() > 0 ? moved.rotation * moved.radius / moved.ofFarthestCorner() : 0.0;
    addContactEvidence(to, b, motion);
    return motion;
}

struct Mode {
    double frequency = 0;  ///< squared [1/s^2]
    double mass = 0;       ///< [kg]
};

/// The frequency at which the inertia added to faster blocks is that share of all; at least the frequency of
/// half of the mass.
double frequencyFor(std::vector<Mode> modes) {
    std::sort(modes.begin(), modes.end(), [](const Mode& a, const Mode& b) {
        return a.frequency != b.frequency ? a.frequency > b.frequency : a.mass > b.mass;
    });
    double mass = 0;
    for (const Mode& mode : modes) mass += mode.mass;
    double stiffness = 0, faster = 0;
    for (std::size_t k = 0; k < modes.size(); ++k) {
        stiffness += modes[k].frequency * modes[k].mass;
        faster += modes[k].mass;
        if (faster >= 0.5 * mass) return modes[k].frequency;
        const double wanted = stiffness / (faster + kAddedInertia * mass);
        if (wanted >= modes[k + 1].frequency) return wanted;
    }
    return 0;
}

}  // namespace

Failure describeFailure(const PositionArray& position, const QuaternionArray& orientation, const State& to,
                        double deflection) {
    const Places from{position, orientation};
    Failure failure;
    std::vector<BlockDisplacement> displacements;
    for (std::size_t b = 0; b < to.blocks.size(); ++b) displacements.push_back(displacementOf(from, to, b));
    const std::vector<FailureMode> roles = motionRoles(displacements, deflection);
    for (std::size_t b = 0; b < displacements.size(); ++b) {
        if (!displacements[b].free) continue;
        failure.motions.push_back(describeBlock(from, to, b, displacements[b], roles[b]));
        if (failure.motions.back().moving) failure.moving_blocks.push_back(failure.motions.back().block);
    }
    sortNaturally(failure.moving_blocks);
    failure.mode = overallMode(displacements, roles);
    return failure;
}

double playedFrequency(const State& state, const std::vector<char>& moving, bool parallel) {
    const std::vector<double> bounds = frequencyBounds(state, parallel);
    std::vector<Mode> all, of_moving;
    for (std::size_t b = 0; b < bounds.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        all.push_back({bounds[b], state.blocks.mass[b]});
        if (moving[b]) of_moving.push_back(all.back());
    }
    return std::max(frequencyFor(std::move(all)), frequencyFor(std::move(of_moving)));
}

void slowDownTo(State& state, double frequency, bool parallel) {
    std::vector<double> scale = frequencyBounds(state, parallel);
    for (double& s : scale) s = frequency > 0 ? std::max(1.0, s / frequency) : 1.0;
    setInertia(state, scale);
}

double rattleDamping(double frequency) { return frequency > 0 ? 2.0 * kDashpot / std::sqrt(frequency) : 0.0; }

}  // namespace talus::failure
