#pragma once
// The kernel's source. A column of a block is six numbers: most of an AVX-512 register, four and two of AVX2, or three pairs.

#include <cstring>

#include "equilibrium/elimination_view.h"
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

/// c -= a b
TALUS_KERNEL void takeProduct(const Columns& a, const double* b, Columns& c) {
    for (std::size_t k = 0; k < kColumn; ++k) {
        const double* by = b + kColumn * k;
        Six sum = a.c[0] * by[0];
        sum = a.c[1] * by[1] + sum;
        sum = a.c[2] * by[2] + sum;
        sum = a.c[3] * by[3] + sum;
        sum = a.c[4] * by[4] + sum;
        sum = a.c[5] * by[5] + sum;
        c.c[k] = c.c[k] - sum;
    }
}

/// Takes the products of all columns' blocks of two numbers, below and beside.
TALUS_KERNEL void takeProducts(const EliminationView& view, std::size_t lower, std::size_t upper,
                               double* from) {
    Columns c = loadBlock(from);
    for (std::size_t a = 0; a < view.column_count; ++a)
        takeProduct(loadBlock(view.columns[a].lower + kBlock * lower), view.columns[a].upper + kBlock * upper,
                    c);
    storeBlock(from, c);
}

void eliminate(const EliminationView& view) {
    for (std::size_t p = 0; p < view.count; ++p) {
        for (std::size_t t = 0; t < view.target_count && t < p; ++t) {
            const std::size_t at = kBlock * static_cast<std::size_t>(view.place[p]);
            takeProducts(view, p, t, view.targets[t].lower + at);
            takeProducts(view, t, p, view.targets[t].upper + at);
        }
        if (p < view.target_count) takeProducts(view, p, p, view.targets[p].diagonal);
    }
}

}  // namespace
}  // namespace talus::equilibrium
