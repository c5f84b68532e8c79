#include "measure/measure.h"

#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "state/block_motion.h"

namespace talus {

double kineticEnergy(const State& state) {
    const Blocks& blocks = state.blocks;
    double sum = 0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks.motion[b] != Motion::free) continue;
        sum += 0.5 * blocks.velocity.get(b).squaredNorm() / blocks.inverse_mass[b] +
               0.5 * blocks.angular_momentum.get(b).dot(angularVelocity(blocks, b));
    }
    return sum;
}

double elasticEnergy(const State& state) {
    double sum = 0;
    for (std::size_t i = 0; i < state.interfaces.size(); ++i) sum += storedEnergy(contactsOf(state), i);
    return sum + tieEnergy(state);
}

namespace {

/// Of the forces that keep their direction, from the start to here, as large as they are now [J].
double workOfDeadForces(const State& state) {
    const Geometry& geometry = *state.geometry;
    double sum = 0;
    eachBlockForce(state, [&](const BlockForce& force, const ForceParts& parts) {
        if (force.dead == nullptr) return;
        for (const std::int32_t on : force.blocks(state, parts)) {
            const auto b = static_cast<std::size_t>(on);
            const DeadForce dead = force.dead(state, parts, b);
            const Mat3 turned = state.blocks.orientation.matrix(b) - geometry.initial_orientation.matrix(b);
            sum += dead.force.dot(state.blocks.position.get(b) - geometry.initial_position.get(b)) +
                   (turned * dead.arms).trace();
        }
    });
    return sum;
}

}  // namespace

double gravityEnergy(const State& state) {
    const Vec3 g = standingAcceleration(state);
    double sum = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        sum -= state.blocks.mass[b] *
               g.dot(state.blocks.position.get(b) - state.geometry->initial_position.get(b));
    }
    return sum - workOfDeadForces(state);
}

double outOfBalanceRatio(const State& state, std::size_t block, const Vec3& acceleration) {
    const Wrench sum = outOfBalance(state, block, acceleration);
    const double magnitude = state.geometry->model.gravity.magnitude;
    const double weight = state.blocks.mass[block] * (magnitude > 0 ? magnitude : 1.0);
    return std::max(sum.force.norm() / weight, sum.torque.norm() / (weight * state.geometry->radius[block]));
}

double outOfBalanceRatio(const State& state) {
    const Vec3 g = bodyAcceleration(state);
    double largest = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] == Motion::free)
            largest = std::max(largest, outOfBalanceRatio(state, b, g));
    }
    return largest;
}

bool isFinite(const State& state) {
    double sum = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        sum += state.blocks.position.get(b).sum() + state.blocks.velocity.get(b).sum() +
               state.blocks.angular_momentum.get(b).sum();
    return std::isfinite(sum);
}

std::uint64_t stateHash(const Blocks& blocks, const EachPoint& points) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash(XXH3_createState(), XXH3_freeState);
    XXH3_64bits_reset(hash.get());
    const auto add = [&](const std::vector<double>& values) {
        XXH3_64bits_update(hash.get(), values.data(), values.size() * sizeof(double));
    };
    const auto addVector = [&](const VectorArray& v) { add(v.x), add(v.y), add(v.z); };
    std::vector<double> column;
    const auto addColumn = [&](const auto& records, auto number) {
        column.clear();
        for (const auto& record : records) column.push_back(record.*number);
        add(column);
    };
    for (const auto number : {&Position::x, &Position::y, &Position::z}) addColumn(blocks.position, number);
    for (const auto number : {&Quaternion::w, &Quaternion::x, &Quaternion::y, &Quaternion::z})
        addColumn(blocks.orientation, number);
    addVector(blocks.velocity);
    addVector(blocks.angular_momentum);
    points([&](const PointNumbers& numbers) { XXH3_64bits_update(hash.get(), &numbers, sizeof numbers); });
    return XXH3_64bits_digest(hash.get());
}

std::uint64_t stateHash(const State& state) {
    return stateHash(state.blocks, [&](const auto& add) {
        for (std::size_t i = 0; i < state.interfaces.size(); ++i)
            for (const ContactPoint& point : contactPoints(state, i))
                add({point.force.normal, point.force.shear_1, point.force.shear_2, point.memory.offset_1,
                     point.memory.offset_2, point.memory.bond});
    });
}

}  // namespace talus
