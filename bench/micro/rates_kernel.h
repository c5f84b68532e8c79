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

#ifdef __AVX512F__
constexpr int kLanes = 8;
#else
constexpr int kLanes = 4;
#endif
constexpr int kChains = 12, kRootChains = 8;
constexpr int kPlainChains = kLanes == 8 ? 24 : 12;  // as many as there are registers for

typedef double Register __attribute__((vector_size(sizeof(double) * kLanes)));

Register registerOf(double v) { return v - Register{}; }
Register load(const double* from) {
    Register v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
void store(double* to, Register v) { std::memcpy(to, &v, sizeof v); }

Register squareRoot(Register v) {
#if defined(__AVX512F__)
    return (Register)_mm512_sqrt_pd((__m512d)v);
#elif defined(__AVX__)
    return (Register)_mm256_sqrt_pd((__m256d)v);
#else
    return Register{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}
Register multiplyAdd(Register a, Register b, Register c) {
#if defined(__AVX512F__)
    return (Register)_mm512_fmadd_pd((__m512d)a, (__m512d)b, (__m512d)c);
#elif defined(__FMA__)
    return (Register)_mm256_fmadd_pd((__m256d)a, (__m256d)b, (__m256d)c);
#else
    return a * b + c;
#endif
}

// A loop over one vector would be turned into a call of memcpy, which goes past the caches when it is long.
void copy(double* to, const double* from, std::size_t n) {
    for (std::size_t i = 0; i + 2 * kLanes <= n; i += 2 * kLanes) {
        const Register a = load(from + i), b = load(from + i + kLanes);
        asm volatile("" ::: "memory");
        store(to + i, a);
        store(to + i + kLanes, b);
    }
}

void triad(double* a, const double* b, const double* c, std::size_t n, double s) {
    const Register factor = registerOf(s);
    for (std::size_t i = 0; i + kLanes <= n; i += kLanes) store(a + i, load(b + i) + factor * load(c + i));
}

double total(const Register* values, int n) {
    Register sum{};
    for (int k = 0; k < n; ++k) sum += values[k];
    double all = 0;
    for (int l = 0; l < kLanes; ++l) all += sum[l];
    return all;
}

/// Independent chains, enough of them to hide the latency; `next` is one operation of each.
template <int Chains, class Next>
double chains(std::size_t rounds, const Next& next) {
    Register value[Chains];
    for (int k = 0; k < Chains; ++k) value[k] = registerOf(1.0 + 1e-3 * k);
    for (std::size_t r = 0; r < rounds; ++r) {
#pragma GCC unroll 24
        for (int k = 0; k < Chains; ++k) value[k] = next(value[k], k);
    }
    return total(value, Chains);
}

double fma(std::size_t rounds) {
    const Register factor = registerOf(0.999), term = registerOf(1e-3);
    return chains<kChains>(rounds, [&](Register v, int) { return multiplyAdd(v, factor, term); });
}
// Every other chain adds, the others multiply: nothing to fuse. As many operations in all, so that a round
// counts the same.
double addMul(std::size_t rounds) {
    const Register factor = registerOf(0.9999999), term = registerOf(1e-9);
    return chains<kPlainChains>(2 * kChains * rounds / kPlainChains,
                                [&](Register v, int k) { return k % 2 == 0 ? v * factor : v + term; });
}
double root(std::size_t rounds) {
    return chains<kRootChains>(rounds, [](Register v, int) { return squareRoot(v); });
}
double division(std::size_t rounds) {
    const Register numerator = registerOf(1.7);
    return chains<kRootChains>(rounds, [&](Register v, int) { return numerator / v; });
}

Rates theseRates() {
    return {copy, triad, fma, addMul, root, division, 2 * kLanes * kChains, kLanes * kRootChains};
}

}  // namespace
}  // namespace talus::bench
