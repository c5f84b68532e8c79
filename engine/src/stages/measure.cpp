#include "stages/measure.h"

#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "stages/contacts.h"
#include "stages/motion.h"

namespace talus::stages {

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
    const ContactPoints& points = state.points;
    double sum = 0;
    for (std::size_t i = 0; i < state.interfaces.size(); ++i) {
        const contact::JointLaw& law = state.laws[static_cast<std::size_t>(state.interfaces.joint[i])];
        const auto end = static_cast<std::size_t>(state.interfaces.point_begin[i + 1]);
        for (auto p = static_cast<std::size_t>(state.interfaces.point_begin[i]); p < end; ++p) {
            const double shear =
                points.shear_1[p] * points.shear_1[p] + points.shear_2[p] * points.shear_2[p];
            sum += 0.5 / points.area[p] *
                   (points.normal[p] * points.normal[p] / law.normal_stiffness + shear / law.shear_stiffness);
        }
    }
    return sum;
}

double gravityEnergy(const State& state) {
    const Vec3 g = gravity(state);
    double sum = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        sum -= state.blocks.mass[b] *
               g.dot(state.blocks.position.get(b) - state.geometry->initial_position.get(b));
    }
    return sum;
}

double outOfBalanceRatio(const State& state) {
    const Vec3 g = gravity(state);
    const double magnitude = state.geometry->model.gravity.magnitude;
    double largest = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        const Wrench sum = outOfBalance(state, b, g);
        const double weight = state.blocks.mass[b] * (magnitude > 0 ? magnitude : 1.0);
        largest = std::max(
            {largest, sum.force.norm() / weight, sum.torque.norm() / (weight * state.geometry->radius[b])});
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

std::uint64_t stateHash(const State& state) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash(XXH3_createState(), XXH3_freeState);
    XXH3_64bits_reset(hash.get());
    const auto add = [&](const std::vector<double>& values) {
        XXH3_64bits_update(hash.get(), values.data(), values.size() * sizeof(double));
    };
    const auto addVector = [&](const VectorArray& v) { add(v.x), add(v.y), add(v.z); };
    const Blocks& blocks = state.blocks;
    addVector(blocks.position);
    add(blocks.orientation.w), add(blocks.orientation.x), add(blocks.orientation.y),
        add(blocks.orientation.z);
    addVector(blocks.velocity);
    addVector(blocks.angular_momentum);
    const ContactPoints& points = state.points;
    add(points.normal), add(points.shear_1), add(points.shear_2);
    add(points.offset_1), add(points.offset_2), add(points.bond);
    return XXH3_64bits_digest(hash.get());
}

double rotationFrom(const QuaternionArray& from, const QuaternionArray& to, std::size_t b) {
    // The vector part of conj(from) * to keeps small angles exact where acos of the scalar part would not.
    const double w = from.w[b] * to.w[b] + from.x[b] * to.x[b] + from.y[b] * to.y[b] + from.z[b] * to.z[b];
    const double x = from.w[b] * to.x[b] - from.x[b] * to.w[b] - from.y[b] * to.z[b] + from.z[b] * to.y[b];
    const double y = from.w[b] * to.y[b] - from.y[b] * to.w[b] - from.z[b] * to.x[b] + from.x[b] * to.z[b];
    const double z = from.w[b] * to.z[b] - from.z[b] * to.w[b] - from.x[b] * to.y[b] + from.y[b] * to.x[b];
    return 2.0 * std::atan2(std::sqrt(x * x + y * y + z * z), std::abs(w));
}

}  // namespace talus::stages
