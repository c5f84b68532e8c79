#pragma once
// Four doubles at a time: the operations of scalar.h for kLanes lanes. Only kernels' own source files include this, and
// everything is local to them, because it is compiled for the instruction set of the file.

#include <cstring>

#include "simd/scalar.h"
#ifdef __AVX__
#include <immintrin.h>
#endif

namespace talus::simd {
namespace {

typedef double LaneValues __attribute__((vector_size(sizeof(double) * kLanes)));
typedef std::int64_t LaneBits __attribute__((vector_size(sizeof(double) * kLanes)));

struct LaneMask {
    LaneBits bits;
};

struct Lanes {
    LaneValues v;
};

TALUS_KERNEL Lanes operator+(Lanes a, Lanes b) { return {a.v + b.v}; }
TALUS_KERNEL Lanes operator-(Lanes a, Lanes b) { return {a.v - b.v}; }
TALUS_KERNEL Lanes operator*(Lanes a, Lanes b) { return {a.v * b.v}; }
TALUS_KERNEL Lanes operator/(Lanes a, Lanes b) { return {a.v / b.v}; }
TALUS_KERNEL Lanes operator-(Lanes a) { return {-a.v}; }
TALUS_KERNEL Lanes operator+(Lanes a, double b) { return {a.v + b}; }
TALUS_KERNEL Lanes operator-(Lanes a, double b) { return {a.v - b}; }
TALUS_KERNEL Lanes operator*(double a, Lanes b) { return {a * b.v}; }
TALUS_KERNEL Lanes operator*(Lanes a, double b) { return {a.v * b}; }
TALUS_KERNEL LaneMask operator<(Lanes a, Lanes b) { return {a.v < b.v}; }
TALUS_KERNEL LaneMask operator>(Lanes a, Lanes b) { return {a.v > b.v}; }
TALUS_KERNEL LaneMask operator<(Lanes a, double b) { return {a.v < b}; }
TALUS_KERNEL LaneMask operator>(Lanes a, double b) { return {a.v > b}; }
TALUS_KERNEL LaneMask operator==(Lanes a, Lanes b) { return {a.v == b.v}; }
TALUS_KERNEL LaneMask operator==(Lanes a, double b) { return {a.v == b}; }
TALUS_KERNEL LaneMask operator!(LaneMask a) { return {~a.bits}; }
TALUS_KERNEL LaneMask both(LaneMask a, LaneMask b) { return {a.bits & b.bits}; }
TALUS_KERNEL LaneMask either(LaneMask a, LaneMask b) { return {a.bits | b.bits}; }

#ifdef __AVX__
TALUS_KERNEL Lanes select(LaneMask mask, Lanes yes, Lanes no) {
    return {_mm256_blendv_pd(no.v, yes.v, (__m256d)mask.bits)};
}
TALUS_KERNEL bool any(LaneMask mask) { return _mm256_movemask_pd((__m256d)mask.bits) != 0; }
TALUS_KERNEL Lanes larger(Lanes a, Lanes b) { return {_mm256_max_pd(a.v, b.v)}; }
TALUS_KERNEL Lanes smaller(Lanes a, Lanes b) { return {_mm256_min_pd(a.v, b.v)}; }
TALUS_KERNEL Lanes squareRoot(Lanes a) { return {_mm256_sqrt_pd(a.v)}; }
#else
TALUS_KERNEL Lanes select(LaneMask mask, Lanes yes, Lanes no) {
    return {(LaneValues)((mask.bits & (LaneBits)yes.v) | (~mask.bits & (LaneBits)no.v))};
}
TALUS_KERNEL bool any(LaneMask mask) {
    return (mask.bits[0] | mask.bits[1] | mask.bits[2] | mask.bits[3]) != 0;
}
TALUS_KERNEL Lanes larger(Lanes a, Lanes b) { return select(a > b, a, b); }
TALUS_KERNEL Lanes smaller(Lanes a, Lanes b) { return select(a < b, a, b); }
TALUS_KERNEL Lanes squareRoot(Lanes a) {
    return {LaneValues{std::sqrt(a.v[0]), std::sqrt(a.v[1]), std::sqrt(a.v[2]), std::sqrt(a.v[3])}};
}
#endif

TALUS_KERNEL Lanes lanesOf(double a, double b, double c, double d) { return {LaneValues{a, b, c, d}}; }
TALUS_KERNEL Lanes loadLanes(const double* from) {
    Lanes a;
    std::memcpy(&a.v, from, sizeof a.v);
    return a;
}
TALUS_KERNEL void storeLanes(double* to, Lanes a) { std::memcpy(to, &a.v, sizeof a.v); }

}  // namespace
}  // namespace talus::simd
