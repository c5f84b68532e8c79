#pragma once
// Arrays for kernels: plain pointers, so that builds for different instruction sets share no code with the
// rest. A container's inline function compiled for AVX2 could be linked in everywhere.

namespace talus::simd {

struct ConstVectors {
    const double *x, *y, *z;
};
struct Vectors {
    double *x, *y, *z;
};

}  // namespace talus::simd
