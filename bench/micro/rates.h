#pragma once
// What the machine can do: loops that do nothing but stream or compute. Built several times, as the engine's
// kernels are: for any x86-64, for AVX2 with FMA and for AVX-512.

#include <cstddef>

namespace talus::bench {

/// One build of the loops. Each returns something that depends on all of its work.
struct Rates {
    void (*copy)(double* to, const double* from, std::size_t n);                          ///< to = from
    void (*triad)(double* a, const double* b, const double* c, std::size_t n, double s);  ///< a = b + s c
    double (*fma)(std::size_t rounds);      ///< flops_per_round floating-point operations a round
    double (*add_mul)(std::size_t rounds);  ///< as many, additions and multiplications that must not be fused
    double (*root)(std::size_t rounds);     ///< roots_per_round square roots a round
    double (*division)(std::size_t rounds);  ///< as many divisions
    int flops_per_round, roots_per_round;
};

Rates plainRates();
Rates avx2Rates();    ///< \pre the processor has AVX2 and FMA
Rates avx512Rates();  ///< \pre simd::isAvailable(InstructionSet::avx512)

}  // namespace talus::bench
