#pragma once
// The loops of rates.h; included by one source file per instruction set.

#include <cmath>
#include <cstring>
#ifdef __AVX__
#include <immintrin.h>
#endif

#include "rates.h"

namespace talus::bench {
namespace {

typedef double Four __attribute__((vector_size(32)));

Four fourOf(double v) { return Four{v, v, v, v}; }
Four load(const double* from) {
    Four v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
void store(double* to, Four v) { std::memcpy(to, &v, sizeof v); }

Four squareRoot(Four v) {
#ifdef __AVX__
    return (Four)_mm256_sqrt_pd((__m256d)v);
#else
    return Four{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}
Four multiplyAdd(Four a, Four b, Four c) {
#ifdef __FMA__
    return (Four)_mm256_fmadd_pd((__m256d)a, (__m256d)b, (__m256d)c);
#else
    return a * b + c;
#endif
}

// A loop over one vector would be turned into a call of memcpy, which goes past the caches when it is long.
void copy(double* to, const double* from, std::size_t n) {
    for (std::size_t i = 0; i + 8 <= n; i += 8) {
        const Four a = load(from + i), b = load(from + i + 4);
        asm volatile("" ::: "memory");
        store(to + i, a);
        store(to + i + 4, b);
    }
}

void triad(double* a, const double* b, const double* c, std::size_t n, double s) {
    const Four factor = fourOf(s);
    for (std::size_t i = 0; i + 4 <= n; i += 4) store(a + i, load(b + i) + factor * load(c + i));
}

double total(const Four* values, int n) {
    Four sum{};
    for (int k = 0; k < n; ++k) sum += values[k];
    return sum[0] + sum[1] + sum[2] + sum[3];
}

/// Independent chains, enough of them to hide the latency; `next` is one operation of each.
template <int Chains, class Next>
double chains(std::size_t rounds, const Next& next) {
    Four value[Chains];
    for (int k = 0; k < Chains; ++k) value[k] = fourOf(1.0 + 1e-3 * k);
    for (std::size_t r = 0; r < rounds; ++r) {
#pragma GCC unroll 16
        for (int k = 0; k < Chains; ++k) value[k] = next(value[k], k);
    }
    return total(value, Chains);
}

double fma(std::size_t rounds) {
    const Four factor = fourOf(0.999), term = fourOf(1e-3);
    return chains<kChains>(rounds, [&](Four v, int) { return multiplyAdd(v, factor, term); });
}
// Every other chain adds, the others multiply: nothing to fuse. Two operations each, so that a round counts the same.
double addMul(std::size_t rounds) {
    const Four factor = fourOf(0.9999999), term = fourOf(1e-9);
    return chains<kChains>(2 * rounds, [&](Four v, int k) { return k % 2 == 0 ? v * factor : v + term; });
}
double root(std::size_t rounds) {
    return chains<kRootChains>(rounds, [](Four v, int) { return squareRoot(v); });
}
double division(std::size_t rounds) {
    const Four numerator = fourOf(1.7);
    return chains<kRootChains>(rounds, [&](Four v, int) { return numerator / v; });
}

Rates theseRates() { return {copy, triad, fma, addMul, root, division}; }

}  // namespace
}  // namespace talus::bench
