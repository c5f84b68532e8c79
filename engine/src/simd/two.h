#pragma once
// Two numbers (each a double or a register of them) side by side in a kernel. While one waits for its last
// result, the processor works on the other.

#include "simd/scalar.h"

namespace talus::simd {

template <class V>
struct Two {
    V a, b;
};
template <class M>
struct TwoMasks {
    M a, b;
};

template <class V>
TALUS_KERNEL Two<V> operator+(const Two<V>& x, const Two<V>& y) {
    return {x.a + y.a, x.b + y.b};
}
template <class V>
TALUS_KERNEL Two<V> operator-(const Two<V>& x, const Two<V>& y) {
    return {x.a - y.a, x.b - y.b};
}
template <class V>
TALUS_KERNEL Two<V> operator*(const Two<V>& x, const Two<V>& y) {
    return {x.a * y.a, x.b * y.b};
}
template <class V>
TALUS_KERNEL Two<V> operator/(const Two<V>& x, const Two<V>& y) {
    return {x.a / y.a, x.b / y.b};
}
template <class V>
TALUS_KERNEL Two<V> operator+(const Two<V>& x, double y) {
    return {x.a + y, x.b + y};
}
template <class V>
TALUS_KERNEL Two<V> operator*(double x, const Two<V>& y) {
    return {x * y.a, x * y.b};
}
template <class V>
TALUS_KERNEL auto operator<(const Two<V>& x, double y) {
    return TwoMasks<MaskOf<V>>{x.a < y, x.b < y};
}
template <class V>
TALUS_KERNEL auto operator>(const Two<V>& x, double y) {
    return TwoMasks<MaskOf<V>>{x.a > y, x.b > y};
}
template <class M, class V>
TALUS_KERNEL Two<V> select(const TwoMasks<M>& mask, const Two<V>& yes, const Two<V>& no) {
    return {select(mask.a, yes.a, no.a), select(mask.b, yes.b, no.b)};
}
template <class V>
TALUS_KERNEL Two<V> larger(const Two<V>& x, const Two<V>& y) {
    return {larger(x.a, y.a), larger(x.b, y.b)};
}
template <class V>
TALUS_KERNEL Two<V> squareRoot(const Two<V>& x) {
    return {squareRoot(x.a), squareRoot(x.b)};
}

}  // namespace talus::simd
