#pragma once
// Four or eight doubles at a time, by the register width of the including file's instruction set: the
// operations of scalar.h for kWidth lanes. Only kernels' own source files include this, and everything is
// local to them.

#include <cstring>

#include "simd/scalar.h"
#include "simd/table.h"
#ifdef __AVX__
#include <immintrin.h>
#endif

namespace talus::simd {
namespace {

#ifdef __AVX512F__
inline constexpr int kWidth = 8;
#else
inline constexpr int kWidth = 4;
#endif

typedef double LaneValues __attribute__((vector_size(sizeof(double) * kWidth)));

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
TALUS_KERNEL Lanes loadLanes(const double* from) {
    Lanes a;
    std::memcpy(&a.v, from, sizeof a.v);
    return a;
}
TALUS_KERNEL void storeLanes(double* to, Lanes a) { std::memcpy(to, &a.v, sizeof a.v); }

#ifdef __AVX512F__

struct LaneMask {
    __mmask8 bits;
};

TALUS_KERNEL LaneMask operator<(Lanes a, Lanes b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LT_OQ)}; }
TALUS_KERNEL LaneMask operator>(Lanes a, Lanes b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_GT_OQ)}; }
TALUS_KERNEL LaneMask operator==(Lanes a, Lanes b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_EQ_OQ)}; }
TALUS_KERNEL LaneMask operator<(Lanes a, double b) { return a < Lanes{_mm512_set1_pd(b)}; }
TALUS_KERNEL LaneMask operator>(Lanes a, double b) { return a > Lanes{_mm512_set1_pd(b)}; }
TALUS_KERNEL LaneMask operator==(Lanes a, double b) { return a == Lanes{_mm512_set1_pd(b)}; }
TALUS_KERNEL LaneMask operator!(LaneMask a) { return {static_cast<__mmask8>(~a.bits)}; }
TALUS_KERNEL LaneMask both(LaneMask a, LaneMask b) { return {static_cast<__mmask8>(a.bits & b.bits)}; }
TALUS_KERNEL LaneMask either(LaneMask a, LaneMask b) { return {static_cast<__mmask8>(a.bits | b.bits)}; }
TALUS_KERNEL void setLane(LaneMask& mask, int lane, bool yes) {
    mask.bits = static_cast<__mmask8>((mask.bits & ~(1U << lane)) | (static_cast<unsigned>(yes) << lane));
}
TALUS_KERNEL Lanes select(LaneMask mask, Lanes yes, Lanes no) {
    return {_mm512_mask_blend_pd(mask.bits, no.v, yes.v)};
}
TALUS_KERNEL bool any(LaneMask mask) { return mask.bits != 0; }
TALUS_KERNEL Lanes larger(Lanes a, Lanes b) { return {_mm512_max_pd(a.v, b.v)}; }
TALUS_KERNEL Lanes smaller(Lanes a, Lanes b) { return {_mm512_min_pd(a.v, b.v)}; }
TALUS_KERNEL Lanes squareRoot(Lanes a) { return {_mm512_sqrt_pd(a.v)}; }

#else

typedef std::int64_t LaneBits __attribute__((vector_size(sizeof(double) * kWidth)));

struct LaneMask {
    LaneBits bits;
};

TALUS_KERNEL LaneMask operator<(Lanes a, Lanes b) { return {a.v < b.v}; }
TALUS_KERNEL LaneMask operator>(Lanes a, Lanes b) { return {a.v > b.v}; }
TALUS_KERNEL LaneMask operator<(Lanes a, double b) { return {a.v < b}; }
TALUS_KERNEL LaneMask operator>(Lanes a, double b) { return {a.v > b}; }
TALUS_KERNEL LaneMask operator==(Lanes a, Lanes b) { return {a.v == b.v}; }
TALUS_KERNEL LaneMask operator==(Lanes a, double b) { return {a.v == b}; }
TALUS_KERNEL LaneMask operator!(LaneMask a) { return {~a.bits}; }
TALUS_KERNEL LaneMask both(LaneMask a, LaneMask b) { return {a.bits & b.bits}; }
TALUS_KERNEL LaneMask either(LaneMask a, LaneMask b) { return {a.bits | b.bits}; }
TALUS_KERNEL void setLane(LaneMask& mask, int lane, bool yes) { mask.bits[lane] = yes ? -1 : 0; }

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
#endif  // __AVX512F__

/// Records of four doubles, one per lane, turned into one register per number, and back (`stride` doubles
/// apart).
using FourLanes = FourOf<Lanes>;
#if defined(__AVX512F__)
/// Halves of rows 0, 2 and of rows 1, 3 side by side: places of the numbers in a register of two records.
TALUS_KERNEL FourLanes transposed(__m512d a, __m512d b, __m512d c, __m512d d) {
    const __m512d ab_even = _mm512_unpacklo_pd(a, b), ab_odd = _mm512_unpackhi_pd(a, b);
    const __m512d cd_even = _mm512_unpacklo_pd(c, d), cd_odd = _mm512_unpackhi_pd(c, d);
    const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
    const __m512i high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    return {{{_mm512_permutex2var_pd(ab_even, low, cd_even)},
             {_mm512_permutex2var_pd(ab_odd, low, cd_odd)},
             {_mm512_permutex2var_pd(ab_even, high, cd_even)},
             {_mm512_permutex2var_pd(ab_odd, high, cd_odd)}}};
}
TALUS_KERNEL __m512d twoRecords(const double* first, const double* second) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(first)), _mm256_loadu_pd(second), 1);
}
TALUS_KERNEL FourLanes loadRecords(const double* const* at) {
    return transposed(twoRecords(at[0], at[4]), twoRecords(at[1], at[5]), twoRecords(at[2], at[6]),
                      twoRecords(at[3], at[7]));
}
/// Consecutive records.
TALUS_KERNEL FourLanes loadRecords(const double* from) {
    return transposed(twoRecords(from, from + 16), twoRecords(from + 4, from + 20),
                      twoRecords(from + 8, from + 24), twoRecords(from + 12, from + 28));
}
TALUS_KERNEL void storeRecords(double* to, std::ptrdiff_t stride, const FourLanes& values) {
    const FourLanes rows =
        transposed(values.number[0].v, values.number[1].v, values.number[2].v, values.number[3].v);
    for (int k = 0; k < 4; ++k) {
        _mm256_storeu_pd(to + stride * k, _mm512_castpd512_pd256(rows.number[k].v));
        _mm256_storeu_pd(to + stride * (4 + k), _mm512_extractf64x4_pd(rows.number[k].v, 1));
    }
}
#elif defined(__AVX__)
TALUS_KERNEL FourLanes transposed(__m256d a, __m256d b, __m256d c, __m256d d) {
    const __m256d ab_even = _mm256_unpacklo_pd(a, b), ab_odd = _mm256_unpackhi_pd(a, b);
    const __m256d cd_even = _mm256_unpacklo_pd(c, d), cd_odd = _mm256_unpackhi_pd(c, d);
    return {{{_mm256_permute2f128_pd(ab_even, cd_even, 0x20)},
             {_mm256_permute2f128_pd(ab_odd, cd_odd, 0x20)},
             {_mm256_permute2f128_pd(ab_even, cd_even, 0x31)},
             {_mm256_permute2f128_pd(ab_odd, cd_odd, 0x31)}}};
}
TALUS_KERNEL FourLanes loadRecords(const double* const* at) {
    return transposed(_mm256_loadu_pd(at[0]), _mm256_loadu_pd(at[1]), _mm256_loadu_pd(at[2]),
                      _mm256_loadu_pd(at[3]));
}
/// Consecutive records.
TALUS_KERNEL FourLanes loadRecords(const double* from) {
    return transposed(_mm256_loadu_pd(from), _mm256_loadu_pd(from + 4), _mm256_loadu_pd(from + 8),
                      _mm256_loadu_pd(from + 12));
}
TALUS_KERNEL void storeRecords(double* to, std::ptrdiff_t stride, const FourLanes& values) {
    const FourLanes rows =
        transposed(values.number[0].v, values.number[1].v, values.number[2].v, values.number[3].v);
    for (int k = 0; k < 4; ++k) _mm256_storeu_pd(to + stride * k, rows.number[k].v);
}
#else
TALUS_KERNEL FourLanes loadRecords(const double* const* at) {
    FourLanes values;
    for (int k = 0; k < 4; ++k)
        for (int l = 0; l < kWidth; ++l) values.number[k].v[l] = at[l][k];
    return values;
}
TALUS_KERNEL FourLanes loadRecords(const double* from) {
    FourLanes values;
    for (int k = 0; k < 4; ++k)
        for (int l = 0; l < kWidth; ++l) values.number[k].v[l] = from[4 * l + k];
    return values;
}
TALUS_KERNEL void storeRecords(double* to, std::ptrdiff_t stride, const FourLanes& values) {
    for (int k = 0; k < 4; ++k)
        for (int l = 0; l < kWidth; ++l) to[stride * l + k] = values.number[k].v[l];
}
#endif

TALUS_KERNEL FourLanes loadRecords(const double* records, const std::int32_t* item) {
    const double* at[kWidth];
    for (int l = 0; l < kWidth; ++l) at[l] = records + 4 * static_cast<std::ptrdiff_t>(item[l]);
    return loadRecords(at);
}

constexpr int kPieceBytesShift = 5;  // 32 bytes a piece

typedef std::uint64_t LaneWords __attribute__((vector_size(sizeof(double) * kWidth)));

}  // namespace

/// The base address is that for the bits of zero; the rest is a shift and a sum.
template <>
struct TablesOf<Lanes> {
    LaneWords zero;

    TALUS_KERNEL void set(int lane, const double* table) {
        zero[lane] = reinterpret_cast<std::uintptr_t>(table) - (kFirstPiece << kPieceBytesShift);
    }
    TALUS_KERNEL const double* table(int lane) const {
        return reinterpret_cast<const double*>(zero[lane] + (kFirstPiece << kPieceBytesShift));
    }
};

namespace {

TALUS_KERNEL FourLanes pieceAt(const TablesOf<Lanes>& tables, Lanes x) {
    const Lanes inside = larger(smaller(x, Lanes{} + kGreatest), Lanes{} + kLeast);
    const LaneWords address = tables.zero + (((LaneWords)inside.v >> kPieceShift) << kPieceBytesShift);
    const double* at[kWidth];
    std::memcpy(at, &address, sizeof at);
    FourLanes found = loadRecords(at);
    if (any(x > found.number[3])) {
        for (int l = 0; l < kWidth; ++l) at[l] = pieceFor(tables.table(l), x.v[l]);
        found = loadRecords(at);
    }
    return found;
}

}  // namespace
}  // namespace talus::simd
