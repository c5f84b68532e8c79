#pragma once
// What the machine can do: loops that do nothing but stream or compute. Built twice, as the engine's kernels are: for any
// x86-64, and for AVX2 with FMA.

#include <cstddef>

namespace talus::bench {

/// One build of the loops. Each returns something that depends on all of its work.
struct Rates {
    void (*copy)(double* to, const double* from, std::size_t n);                          ///< to = from
    void (*triad)(double* a, const double* b, const double* c, std::size_t n, double s);  ///< a = b + s c
    double (*fma)(std::size_t rounds);      ///< kFlopsPerRound floating-point operations a round
    double (*add_mul)(std::size_t rounds);  ///< as many, additions and multiplications that must not be fused
    double (*root)(std::size_t rounds);     ///< kRootsPerRound square roots a round
    double (*division)(std::size_t rounds);  ///< as many divisions
};

inline constexpr int kLanes = 4, kChains = 12, kRootChains = 8;
inline constexpr int kFlopsPerRound = 2 * kLanes * kChains;
inline constexpr int kRootsPerRound = kLanes * kRootChains;

Rates plainRates();
Rates avx2Rates();  ///< \pre the processor has AVX2 and FMA

}  // namespace talus::bench
