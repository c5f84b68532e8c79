#pragma once
// The operations that kernels are written in, for one double. `lanes.h` has the same for several doubles in a
// register: a kernel written as a template over the number type is its own scalar twin. Everything here is
// inlined by force, so that no copy compiled for a newer instruction set can be linked into other files.

#include <cmath>
#include <cstddef>
#include <cstdint>

#define TALUS_KERNEL [[gnu::always_inline]] inline

namespace talus::simd {

/// Interfaces that lie side by side in memory: the doubles of an AVX-512 register, and of a cache line.
inline constexpr int kLanes = 8;

template <class V>
using MaskOf = decltype(V{} < V{});

TALUS_KERNEL double select(bool mask, double yes, double no) { return mask ? yes : no; }
TALUS_KERNEL bool both(bool a, bool b) { return a && b; }
TALUS_KERNEL bool either(bool a, bool b) { return a || b; }
TALUS_KERNEL bool any(bool mask) { return mask; }
TALUS_KERNEL double larger(double a, double b) { return a > b ? a : b; }
TALUS_KERNEL double smaller(double a, double b) { return a < b ? a : b; }
TALUS_KERNEL double squareRoot(double a) { return std::sqrt(a); }

/// A vector in space.
template <class V>
struct Triple {
    V x, y, z;
};

template <class V>
TALUS_KERNEL Triple<V> operator+(const Triple<V>& a, const Triple<V>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
TALUS_KERNEL Triple<V> operator-(const Triple<V>& a, const Triple<V>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
TALUS_KERNEL Triple<V> operator*(const V& s, const Triple<V>& a) {
    return {s * a.x, s * a.y, s * a.z};
}
template <class V>
TALUS_KERNEL V dot(const Triple<V>& a, const Triple<V>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
TALUS_KERNEL Triple<V> cross(const Triple<V>& a, const Triple<V>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A rotation: the columns are the turned axes.
template <class V>
struct Rotation {
    Triple<V> e1, e2, e3;

    TALUS_KERNEL Triple<V> operator*(const Triple<V>& a) const { return a.x * e1 + a.y * e2 + a.z * e3; }
    TALUS_KERNEL Triple<V> back(const Triple<V>& a) const { return {dot(e1, a), dot(e2, a), dot(e3, a)}; }
};

/// Of a unit quaternion.
template <class V>
TALUS_KERNEL Rotation<V> rotationOf(V w, V x, V y, V z) {
    const V x2 = x + x, y2 = y + y, z2 = z + z;
    const V xx = x * x2, yy = y * y2, zz = z * z2, xy = x * y2, xz = x * z2, yz = y * z2;
    const V wx = w * x2, wy = w * y2, wz = w * z2;
    const V one = V{} + 1.0;
    return {{one - (yy + zz), xy + wz, xz - wy},
            {xy - wz, one - (xx + zz), yz + wx},
            {xz + wy, yz - wx, one - (xx + yy)}};
}

}  // namespace talus::simd
