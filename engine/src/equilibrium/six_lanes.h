#pragma once
// Blocks of 6 x 6 numbers in registers. A column of a block is six numbers: most of an AVX-512 register, four
// and two of AVX2, or three pairs.

#include <cstddef>
#include <cstring>

#include "simd/scalar.h"
#ifdef __AVX512F__
#include <immintrin.h>
#endif

namespace talus::equilibrium {
namespace {

constexpr std::size_t kBlock = 36, kColumn = 6;

#ifdef __AVX512F__

struct Six {
    __m512d v;
};
constexpr __mmask8 kSix = 0x3f;
TALUS_KERNEL Six load(const double* from) { return {_mm512_maskz_loadu_pd(kSix, from)}; }
TALUS_KERNEL void store(double* to, const Six& a) { _mm512_mask_storeu_pd(to, kSix, a.v); }
TALUS_KERNEL Six operator*(const Six& a, double b) { return {a.v * b}; }
TALUS_KERNEL Six operator+(const Six& a, const Six& b) { return {a.v + b.v}; }
TALUS_KERNEL Six operator-(const Six& a, const Six& b) { return {a.v - b.v}; }

#else

typedef double Two __attribute__((vector_size(2 * sizeof(double))));
#ifdef __AVX__
typedef double Four __attribute__((vector_size(4 * sizeof(double))));
#else
struct Four {
    Two a, b;
};
TALUS_KERNEL Four operator*(const Four& x, double y) { return {x.a * y, x.b * y}; }
TALUS_KERNEL Four operator+(const Four& x, const Four& y) { return {x.a + y.a, x.b + y.b}; }
TALUS_KERNEL Four operator-(const Four& x, const Four& y) { return {x.a - y.a, x.b - y.b}; }
#endif

struct Six {
    Four a;
    Two b;
};
TALUS_KERNEL Six load(const double* from) {
    Six x;
    std::memcpy(&x.a, from, sizeof x.a);
    std::memcpy(&x.b, from + 4, sizeof x.b);
    return x;
}
TALUS_KERNEL void store(double* to, const Six& x) {
    std::memcpy(to, &x.a, sizeof x.a);
    std::memcpy(to + 4, &x.b, sizeof x.b);
}
TALUS_KERNEL Six operator*(const Six& x, double y) { return {x.a * y, x.b * y}; }
TALUS_KERNEL Six operator+(const Six& x, const Six& y) { return {x.a + y.a, x.b + y.b}; }
TALUS_KERNEL Six operator-(const Six& x, const Six& y) { return {x.a - y.a, x.b - y.b}; }

#endif

/// A block's columns.
struct Columns {
    Six c[kColumn];
};
TALUS_KERNEL Columns loadBlock(const double* block) {
    return {{load(block), load(block + 6), load(block + 12), load(block + 18), load(block + 24),
             load(block + 30)}};
}

TALUS_KERNEL void storeBlock(double* block, const Columns& a) {
    for (std::size_t k = 0; k < kColumn; ++k) store(block + kColumn * k, a.c[k]);
}

/// a b
TALUS_KERNEL Six product(const Columns& a, const double* b) {
    Six sum = a.c[0] * b[0];
    sum = a.c[1] * b[1] + sum;
    sum = a.c[2] * b[2] + sum;
    sum = a.c[3] * b[3] + sum;
    sum = a.c[4] * b[4] + sum;
    return a.c[5] * b[5] + sum;
}

/// c -= a b
TALUS_KERNEL void takeProduct(const Columns& a, const double* b, Columns& c) {
    for (std::size_t k = 0; k < kColumn; ++k) c.c[k] = c.c[k] - product(a, b + kColumn * k);
}

}  // namespace
}  // namespace talus::equilibrium
