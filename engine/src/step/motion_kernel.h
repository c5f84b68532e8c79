#pragma once
// Half kick and drift, gather and half kick, for one block (V = double) or several in a register (V = Lanes);
// one source, a build per instruction set.

#include <cstring>

#include "simd/scalar.h"
#include "simd/two.h"
#include "step/motion_view.h"

namespace talus {
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

/// The last blocks that fill V, when those before `from` are done: these stay unchanged.
/// \pre `block` and what follows belong to the caller's range
template <class V>
struct Last;

/// Two of the above, as one. A drift is one long chain of operations that wait for each other.
template <class V, class A, class B>
struct SideBySide {
    using Two = simd::Two<V>;
    A a;
    B b;

    TALUS_KERNEL Two load(const double* values) const { return {a.load(values), b.load(values)}; }
    TALUS_KERNEL void store(double* values, const Two& v) const {
        a.store(values, v.a);
        b.store(values, v.b);
    }
    TALUS_KERNEL auto flags(const std::uint8_t* values) const {
        return simd::TwoMasks<simd::MaskOf<V>>{a.flags(values), b.flags(values)};
    }
    TALUS_KERNEL Four<Two> loadFour(const double* records) const {
        const Four<V> x = a.loadFour(records), y = b.loadFour(records);
        return {{x.a, y.a}, {x.b, y.b}, {x.c, y.c}, {x.d, y.d}};
    }
    TALUS_KERNEL void storeFour(double* records, const Four<Two>& v) const {
        a.storeFour(records, {v.a.a, v.b.a, v.c.a, v.d.a});
        b.storeFour(records, {v.a.b, v.b.b, v.c.b, v.d.b});
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

/// Turns the pair (angular momentum in the block's frame, orientation) about one principal axis: the exact
/// flow of one third of the free rigid body's energy, with tan(angle/2) ~ angle/2. It stays symplectic, as
/// the exact flow of a function of the same component, and of second order. `t` is that tangent; a, j, k go
/// round x, y, z. Splitting after Dullweber, Leimkuhler and McLachlan, J. Chem. Phys. 107 (1997) 5840.
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

/// What moves a block, while it is in registers.
template <class V>
struct MomentaOf {
    Triple<V> velocity, angular_momentum, force, torque;
};
template <class V, class C>
TALUS_KERNEL MomentaOf<V> loadMomenta(const MotionView& view, const C& at) {
    return {load(at, view.velocity), load(at, view.angular_momentum), load(at, view.force),
            load(at, view.torque)};
}
template <class V, class C>
TALUS_KERNEL void storeMomenta(const MotionView& view, const C& at, const MomentaOf<V>& m) {
    store(at, view.velocity, m.velocity);
    store(at, view.angular_momentum, m.angular_momentum);
}

template <class V, class C>
TALUS_KERNEL void driftBlocks(const MotionView& view, const C& at, const MomentaOf<V>& m) {
    using simd::select;
    const auto free = at.flags(view.free);
    const Triple<V> inverse_inertia = load(at, view.inverse_inertia);
    const double half = 0.5 * view.time_step;

    const V kick = half * at.load(view.inverse_mass);
    const Triple<V> velocity =
        selectTriple(free, (V{} + view.decay) * m.velocity + kick * m.force, m.velocity);
    const Triple<V> momentum = selectTriple(
        free, (V{} + view.spin_decay) * m.angular_momentum + (V{} + half) * m.torque, m.angular_momentum);
    storeMomenta(view, at, MomentaOf<V>{velocity, momentum, m.force, m.torque});
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

/// Cundall's local damping: a share of the out-of-balance force that opposes the motion, component by
/// component.
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

/// Local damping, which goes into the stored force and torque, and the second half kick.
template <class V, class C>
TALUS_KERNEL MomentaOf<V> kicked(const MotionView& view, const C& at, MomentaOf<V> m) {
    const auto free = at.flags(view.free);
    const double half = 0.5 * view.time_step;
    if (view.local_damping > 0) {
        m.force = selectTriple(free, locallyDamped(m.force, m.velocity, view.local_damping), m.force);
        m.torque = selectTriple(
            free, locallyDamped(m.torque, load(at, view.angular_velocity), view.local_damping), m.torque);
        store(at, view.force, m.force);
        store(at, view.torque, m.torque);
    }
    const V kick = half * at.load(view.inverse_mass), decay = V{} + view.decay, spin = V{} + view.spin_decay;
    m.velocity = selectTriple(free, decay * (m.velocity + kick * m.force), m.velocity);
    m.angular_momentum =
        selectTriple(free, spin * (m.angular_momentum + (V{} + half) * m.torque), m.angular_momentum);
    return m;
}

/// Three numbers side by side and one that is not used, so that one load and one addition do for the three.
typedef double ThreeOfFour __attribute__((vector_size(4 * sizeof(double))));

/// Weight and interfaces of free blocks, added up in stored order, into force and torque.
inline void sumWrenches(const MotionView& view, std::size_t begin, std::size_t end) {
    constexpr double kSign[2] = {-1.0, 1.0};  // of the force on b, as a's and as b's
    // Locals, because the compiler cannot exclude that writes change the view's members.
    const double *const mass = view.mass, *const wrenches = view.wrenches;
    const std::int64_t* const interface_begin = view.interface_begin;
    const std::int32_t* const places = view.wrench;
    const std::uint8_t* const free = view.free;
    const simd::Vectors force_out = view.force, torque_out = view.torque;
    const ThreeOfFour gravity{view.gravity[0], view.gravity[1], view.gravity[2], 0.0};
    for (std::size_t b = begin; b < end; ++b) {
        if (free[b] == 0) continue;
        ThreeOfFour force = mass[b] * gravity, torque{};
        for (std::int64_t k = interface_begin[b]; k < interface_begin[b + 1]; ++k) {
            // Without branches: the side of a block follows no pattern.
            const auto place = static_cast<std::uint32_t>(places[k]), is_b = place & 1U;
            const double* record = wrenches + 9 * static_cast<std::size_t>(place >> 1U);
            ThreeOfFour on_b, moment;
            std::memcpy(&on_b, record, sizeof on_b);
            std::memcpy(&moment, record + 2 + 3 * is_b, sizeof moment);  // the three are its last
            force += kSign[is_b] * on_b;
            torque += moment;
        }
        force_out.x[b] = force[0], force_out.y[b] = force[1], force_out.z[b] = force[2];
        torque_out.x[b] = torque[1], torque_out.y[b] = torque[2], torque_out.z[b] = torque[3];
    }
}

/// The kernels, for blocks one at a time and as many at a time as fit into V.
struct Drift {
    template <class V, class C>
    TALUS_KERNEL static void on(const MotionView& view, const C& at) {
        driftBlocks(view, at, loadMomenta<V>(view, at));
    }
};
struct Kick {
    template <class V, class C>
    TALUS_KERNEL static void on(const MotionView& view, const C& at) {
        storeMomenta(view, at, kicked(view, at, loadMomenta<V>(view, at)));
    }
};
struct KickAndDrift {
    template <class V, class C>
    TALUS_KERNEL static void on(const MotionView& view, const C& at) {
        driftBlocks(view, at, kicked(view, at, loadMomenta<V>(view, at)));
    }
};

template <class Kernel, class V>
void onBlocks(const MotionView& view, std::size_t begin, std::size_t end) {
    using Two = simd::Two<V>;
    constexpr std::size_t width = Consecutive<V>::kWidth;
    [[maybe_unused]] const std::size_t first = begin;
    for (; begin + 2 * width <= end; begin += 2 * width)
        Kernel::template on<Two>(view,
                                 SideBySide<V, Consecutive<V>, Consecutive<V>>{{begin}, {begin + width}});
    if constexpr (width == 1) {
        if (begin < end) Kernel::template on<V>(view, Consecutive<V>{begin});
    } else if (first + width > end) {
        for (; begin < end; ++begin) Kernel::template on<double>(view, Consecutive<double>{begin});
    } else if (begin + width < end) {
        const Last<V> last{{end - width}, begin + width};
        Kernel::template on<Two>(view, SideBySide<V, Consecutive<V>, Last<V>>{{begin}, last});
    } else if (begin < end) {
        Kernel::template on<V>(view, Last<V>{{end - width}, begin});
    }
}

template <class V>
constexpr MotionKernels kMotionKernels{sumWrenches, onBlocks<Kick, V>, onBlocks<Drift, V>,
                                       onBlocks<KickAndDrift, V>};

}  // namespace
}  // namespace talus
