#include "stages/motion.h"

#include <cmath>

#include "stages/contacts.h"

namespace talus::stages {
namespace {

/// Turns the pair (angular momentum in the block's frame, orientation) about one principal axis for a time: the exact
/// flow of one third of the free rigid body's energy, but for tan(angle/2) ~ angle/2, which keeps it symplectic (it is
/// the exact flow of a function of the same component) and second order.
/// Splitting after Dullweber, Leimkuhler and McLachlan, J. Chem. Phys. 107 (1997) 5840.
template <int Axis>
void spinAbout(double time, const Vec3& inverse_inertia, Vec3& momentum, Eigen::Vector4d& q) {
    constexpr int j = (Axis + 1) % 3, k = (Axis + 2) % 3;
    const double t = 0.5 * time * inverse_inertia[Axis] * momentum[Axis];
    const double norm = 1.0 / (1.0 + t * t);
    const double c = (1.0 - t * t) * norm, s = 2.0 * t * norm;
    const double m_j = momentum[j], m_k = momentum[k];
    momentum[j] = c * m_j + s * m_k;
    momentum[k] = c * m_k - s * m_j;
    // q <- q * (1 + t e_axis); its length is restored once at the end.
    const double w = q[0], a = q[1 + Axis], b = q[1 + j], d = q[1 + k];
    q[0] = w - t * a;
    q[1 + Axis] = a + t * w;
    q[1 + j] = b + t * d;
    q[1 + k] = d - t * b;
}

/// Free rotation over dt: the angular momentum in the model frame stays, the orientation turns under it.
void rotate(Blocks& blocks, std::size_t b, double dt) {
    const Vec3 inverse_inertia = blocks.inverse_inertia.get(b);
    QuaternionArray& o = blocks.orientation;
    Vec3 momentum = o.matrix(b).transpose() * blocks.angular_momentum.get(b);
    Eigen::Vector4d q(o.w[b], o.x[b], o.y[b], o.z[b]);
    spinAbout<0>(dt / 2, inverse_inertia, momentum, q);
    spinAbout<1>(dt / 2, inverse_inertia, momentum, q);
    spinAbout<2>(dt, inverse_inertia, momentum, q);
    spinAbout<1>(dt / 2, inverse_inertia, momentum, q);
    spinAbout<0>(dt / 2, inverse_inertia, momentum, q);
    q /= q.norm();
    o.w[b] = q[0];
    o.x[b] = q[1];
    o.y[b] = q[2];
    o.z[b] = q[3];
}

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
        const auto i = static_cast<std::size_t>(incidence.interface[static_cast<std::size_t>(k)]);
        const bool is_b = incidence.side[static_cast<std::size_t>(k)] != 0;
        const Vec3 force = state.interfaces.force.get(i);
        sum.force += is_b ? force : Vec3(-force);
        sum.torque += is_b ? state.interfaces.moment_b.get(i) : state.interfaces.moment_a.get(i);
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
    const double decay = std::exp(-0.5 * dt * state.damping.mass);
    const double spin_decay = std::exp(-0.5 * dt * state.damping.rotation);
    for (std::size_t b = range.begin; b < range.end; ++b) {
        if (blocks.motion[b] == Motion::fixed) continue;
        if (blocks.motion[b] == Motion::free) {
            const Vec3 v =
                decay * blocks.velocity.get(b) + (0.5 * dt * blocks.inverse_mass[b]) * blocks.force.get(b);
            blocks.velocity.set(b, v);
            blocks.angular_momentum.set(
                b, spin_decay * blocks.angular_momentum.get(b) + 0.5 * dt * blocks.torque.get(b));
            rotate(blocks, b, dt);
        }
        blocks.position.set(b, blocks.position.get(b) + dt * blocks.velocity.get(b));
    }
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
            sum.torque = locallyDamped(sum.torque, angularVelocity(blocks, b), state.damping.local);
        }
        blocks.force.set(b, sum.force);
        blocks.torque.set(b, sum.torque);
        blocks.velocity.set(
            b, decay * (blocks.velocity.get(b) + (0.5 * dt * blocks.inverse_mass[b]) * sum.force));
        blocks.angular_momentum.set(b, spin_decay * (blocks.angular_momentum.get(b) + 0.5 * dt * sum.torque));
    }
}

}  // namespace talus::stages
