#include "state/block_motion.h"

#include <algorithm>
#include <cmath>

namespace talus {

void setInertia(State& state, const std::vector<double>& scale) {
    Blocks& blocks = state.blocks;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks.motion[b] != Motion::free) continue;
        const Vec3 inverse = blocks.inertia.get(b).cwiseInverse() / scale[b];
        const double change = inverse.x() > 0 ? blocks.inverse_inertia.x[b] / inverse.x() : 1.0;
        blocks.angular_momentum.set(b, change * blocks.angular_momentum.get(b));
        blocks.inverse_mass[b] = 1.0 / (blocks.mass[b] * scale[b]);
        blocks.inverse_inertia.set(b, inverse);
    }
}

void setAtRest(Blocks& blocks) {
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks.motion[b] != Motion::free) continue;
        blocks.velocity.set(b, Vec3::Zero());
        blocks.angular_momentum.set(b, Vec3::Zero());
    }
}

Vec3 angularVelocity(const Blocks& blocks, std::size_t block) {
    const Mat3 r = blocks.orientation.matrix(block);
    return r *
           blocks.inverse_inertia.get(block).cwiseProduct(r.transpose() * blocks.angular_momentum.get(block));
}

void updateSpin(State& state, Range range) {
    for (std::size_t b = range.begin; b < range.end; ++b)
        state.blocks.angular_velocity.set(b, angularVelocity(state.blocks, b));
}

double speedBound(const State& state, std::size_t b) {
    return state.blocks.velocity.get(b).norm() +
           angularVelocity(state.blocks, b).norm() * state.geometry->radius[b];
}

Vec3 velocityAt(const Blocks& blocks, std::size_t b, const Vec3& place) {
    return blocks.velocity.get(b) + angularVelocity(blocks, b).cross(place - blocks.position.get(b));
}

double rotationFrom(const QuaternionArray& froms, const QuaternionArray& tos, std::size_t b) {
    const Quaternion &from = froms[b], &to = tos[b];
    // The vector part of conj(from) * to keeps small angles exact where acos of the scalar part would not.
    const double w = from.w * to.w + from.x * to.x + from.y * to.y + from.z * to.z;
    const double x = from.w * to.x - from.x * to.w - from.y * to.z + from.z * to.y;
    const double y = from.w * to.y - from.y * to.w - from.z * to.x + from.x * to.z;
    const double z = from.w * to.z - from.z * to.w - from.x * to.y + from.y * to.x;
    return 2.0 * std::atan2(std::sqrt(x * x + y * y + z * z), std::abs(w));
}

double wayFrom(const PositionArray& position, const QuaternionArray& orientation, const State& state,
               std::size_t block) {
    const double shift = (state.blocks.position.get(block) - position.get(block)).norm();
    const double turn = rotationFrom(orientation, state.blocks.orientation, block);
    return shift + turn * state.geometry->radius[block];
}

double largestMotion(const State& state, const PositionArray& position, const QuaternionArray& orientation) {
    double largest = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] == Motion::free)
            largest = std::max(largest, wayFrom(position, orientation, state, b));
    }
    return largest;
}

Vec3 rotationVector(const Quaternion& from, const Quaternion& to) {
    const double w = from.w * to.w + from.x * to.x + from.y * to.y + from.z * to.z;
    const Vec3 u(from.x, from.y, from.z), v(to.x, to.y, to.z);
    const Vec3 part = from.w * v - to.w * u - v.cross(u);  // of to * conj(from)
    const double sine = part.norm();
    if (sine == 0) return Vec3::Zero();
    const Vec3 axis = part / (w < 0 ? -sine : sine);
    return 2.0 * std::atan2(sine, std::abs(w)) * axis;
}

}  // namespace talus
