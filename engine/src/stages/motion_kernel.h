#pragma once
// Half kick and drift, gather and half kick, for one block (V = double) or several in a register (V = Lanes); one source, a
// build per instruction set.

#include <cstring>

#include "simd/scalar.h"
#include "stages/motion_view.h"

namespace talus::stages {
namespace {

using simd::Triple;

/// The four numbers of a block's record: w, x, y, z of a quaternion; x, y, z of a position and one unused.
template <class V>
struct Four {
    V a, b, c, d;
};
template <class V>
struct QuaternionOf {
    V w, x, y, z;
};

/// How V is read from arrays at consecutive blocks.
template <class V>
struct Consecutive;

template <>
struct Consecutive<double> {
    static constexpr std::size_t kWidth = 1;
    std::size_t block;
    TALUS_KERNEL double load(const double* values) const { return values[block]; }
    TALUS_KERNEL void store(double* values, double v) const { values[block] = v; }
    TALUS_KERNEL bool flags(const std::uint8_t* values) const { return values[block] != 0; }
    TALUS_KERNEL Four<double> loadFour(const double* records) const {
        const double* r = records + 4 * block;
        return {r[0], r[1], r[2], r[3]};
    }
    TALUS_KERNEL void storeFour(double* records, const Four<double>& v) const {
        double* r = records + 4 * block;
        r[0] = v.a, r[1] = v.b, r[2] = v.c, r[3] = v.d;
    }
};

template <class C, class Pointers>
TALUS_KERNEL auto load(const C& at, const Pointers& from) {
    return Triple<decltype(at.load(from.x))>{at.load(from.x), at.load(from.y), at.load(from.z)};
}
template <class C, class V>
TALUS_KERNEL void store(const C& at, const simd::Vectors& to, const Triple<V>& v) {
    at.store(to.x, v.x);
    at.store(to.y, v.y);
    at.store(to.z, v.z);
}
template <class Mask, class V>
TALUS_KERNEL Triple<V> selectTriple(const Mask& mask, const Triple<V>& yes, const Triple<V>& no) {
    using simd::select;
    return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

/// Turns the pair (angular momentum in the block's frame, orientation) about one principal axis: the exact flow of one
/// third of the free rigid body's energy, but for tan(angle/2) ~ angle/2, which keeps it symplectic (it is the exact
/// flow of a function of the same component) and second order. `t` is that tangent; a, j, k go round x, y, z.
/// Splitting after Dullweber, Leimkuhler and McLachlan, J. Chem. Phys. 107 (1997) 5840.
template <class V>
TALUS_KERNEL void spinAbout(V t, V& m_j, V& m_k, V& q_w, V& q_a, V& q_j, V& q_k) {
    const V one = V{} + 1.0;
    const V norm = one / (one + t * t);
    const V c = (one - t * t) * norm, s = 2.0 * t * norm;
    const V j = m_j, k = m_k;
    m_j = c * j + s * k;
    m_k = c * k - s * j;
    // q <- q * (1 + t e_axis); its length is restored once at the end.
    const V w = q_w, a = q_a, b = q_j, d = q_k;
    q_w = w - t * a;
    q_a = a + t * w;
    q_j = b + t * d;
    q_k = d - t * b;
}

/// Free rotation over dt: the angular momentum in the model frame stays, the orientation turns under it.
template <class V>
TALUS_KERNEL QuaternionOf<V> turned(QuaternionOf<V> q, const Triple<V>& inverse_inertia,
                                    const Triple<V>& momentum, double dt) {
    Triple<V> m = simd::rotationOf(q.w, q.x, q.y, q.z).back(momentum);
    const double quarter = 0.25 * dt, half = 0.5 * dt;
    spinAbout(quarter * inverse_inertia.x * m.x, m.y, m.z, q.w, q.x, q.y, q.z);
    spinAbout(quarter * inverse_inertia.y * m.y, m.z, m.x, q.w, q.y, q.z, q.x);
    spinAbout(half * inverse_inertia.z * m.z, m.x, m.y, q.w, q.z, q.x, q.y);
    spinAbout(quarter * inverse_inertia.y * m.y, m.z, m.x, q.w, q.y, q.z, q.x);
    spinAbout(quarter * inverse_inertia.x * m.x, m.y, m.z, q.w, q.x, q.y, q.z);
    using simd::squareRoot;
    const V length = squareRoot(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w / length, q.x / length, q.y / length, q.z / length};
}

template <class V, class C>
TALUS_KERNEL void driftBlocks(const MotionView& view, const C& at) {
    using simd::select;
    const auto free = at.flags(view.free);
    const Triple<V> inverse_inertia = load(at, view.inverse_inertia);
    const double half = 0.5 * view.time_step;

    Triple<V> velocity = load(at, view.velocity), momentum = load(at, view.angular_momentum);
    const V kick = half * at.load(view.inverse_mass);
    velocity = selectTriple(free, (V{} + view.decay) * velocity + kick * load(at, view.force), velocity);
    momentum = selectTriple(free, (V{} + view.spin_decay) * momentum + (V{} + half) * load(at, view.torque),
                            momentum);
    store(at, view.velocity, velocity);
    store(at, view.angular_momentum, momentum);
    const Four<V> x = at.loadFour(view.position);
    const Triple<V> place = Triple<V>{x.a, x.b, x.c} + (V{} + view.time_step) * velocity;
    at.storeFour(view.position, {place.x, place.y, place.z, x.d});

    const Four<V> r = at.loadFour(view.orientation);
    const QuaternionOf<V> q{r.a, r.b, r.c, r.d};
    const QuaternionOf<V> next = turned(q, inverse_inertia, momentum, view.time_step);
    const QuaternionOf<V> now{select(free, next.w, q.w), select(free, next.x, q.x), select(free, next.y, q.y),
                              select(free, next.z, q.z)};
    at.storeFour(view.orientation, {now.w, now.x, now.y, now.z});

    const simd::Rotation<V> turn = simd::rotationOf(now.w, now.x, now.y, now.z);
    const Triple<V> own = turn.back(momentum);
    store(at, view.angular_velocity,
          turn * Triple<V>{inverse_inertia.x * own.x, inverse_inertia.y * own.y, inverse_inertia.z * own.z});
}

/// Cundall's local damping: a share of the out-of-balance force that opposes the motion, component by component.
template <class V>
TALUS_KERNEL V locallyDamped(const V& force, const V& velocity, double share) {
    using simd::larger, simd::select;
    const V zero{}, magnitude = larger(force, zero - force);
    const V opposing = select(velocity > 0.0, zero - magnitude, select(velocity < 0.0, magnitude, zero));
    return force + share * opposing;
}
template <class V>
TALUS_KERNEL Triple<V> locallyDamped(const Triple<V>& force, const Triple<V>& velocity, double share) {
    return {locallyDamped(force.x, velocity.x, share), locallyDamped(force.y, velocity.y, share),
            locallyDamped(force.z, velocity.z, share)};
}

template <class V, class C>
TALUS_KERNEL void kickBlocks(const GatherView& view, const C& at) {
    const auto free = at.flags(view.free);
    const double half = 0.5 * view.time_step;
    const Triple<V> velocity = load(at, view.velocity), momentum = load(at, view.angular_momentum);
    Triple<V> force = load(at, view.force), torque = load(at, view.torque);
    if (view.local_damping > 0) {
        force = selectTriple(free, locallyDamped(force, velocity, view.local_damping), force);
        torque = selectTriple(
            free, locallyDamped(torque, load(at, view.angular_velocity), view.local_damping), torque);
        store(at, view.force, force);
        store(at, view.torque, torque);
    }
    const V kick = half * at.load(view.inverse_mass), decay = V{} + view.decay, spin = V{} + view.spin_decay;
    store(at, view.velocity, selectTriple(free, decay * (velocity + kick * force), velocity));
    store(at, view.angular_momentum, selectTriple(free, spin * (momentum + (V{} + half) * torque), momentum));
}

/// Three numbers side by side and one that is not used, so that one load and one addition do for the three.
typedef double ThreeOfFour __attribute__((vector_size(4 * sizeof(double))));

TALUS_KERNEL void sumWrench(const GatherView& view, std::size_t b) {
    const double mass = view.mass[b];
    ThreeOfFour force{mass * view.gravity[0], mass * view.gravity[1], mass * view.gravity[2], 0.0}, torque{};
    for (std::int64_t k = view.interface_begin[b]; k < view.interface_begin[b + 1]; ++k) {
        // Without branches: which side a block is on follows no pattern.
        const std::int32_t wrench = view.wrench[k], is_b = wrench % 2;
        const double* record = view.wrenches + 9 * static_cast<std::ptrdiff_t>(wrench / 2);
        ThreeOfFour on_b, moment;
        std::memcpy(&on_b, record, sizeof on_b);
        std::memcpy(&moment, record + 2 + 3 * is_b, sizeof moment);  // the three are its last
        force += static_cast<double>(2 * is_b - 1) * on_b;
        torque += moment;
    }
    view.force.x[b] = force[0], view.force.y[b] = force[1], view.force.z[b] = force[2];
    view.torque.x[b] = torque[1], view.torque.y[b] = torque[2], view.torque.z[b] = torque[3];
}

TALUS_KERNEL void sumWrenches(const GatherView& view, std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
        if (view.free[b] != 0) sumWrench(view, b);
}

/// As many at a time as fit into V, from `begin` on; returns the first block that was left over.
template <class V>
std::size_t driftRange(const MotionView& view, std::size_t begin, std::size_t end) {
    constexpr std::size_t width = Consecutive<V>::kWidth;
    for (; begin + width <= end; begin += width) driftBlocks<V>(view, Consecutive<V>{begin});
    return begin;
}
template <class V>
std::size_t kickRange(const GatherView& view, std::size_t begin, std::size_t end) {
    constexpr std::size_t width = Consecutive<V>::kWidth;
    for (; begin + width <= end; begin += width) kickBlocks<V>(view, Consecutive<V>{begin});
    return begin;
}

}  // namespace
}  // namespace talus::stages
