#pragma once
// Random numbers without a state: number n of stream s is a function of (seed, s, n). So a sample does not
// depend on the worker or on earlier draws, and any sample can be drawn again alone.

#include <array>
#include <cstdint>
#include <string_view>

namespace talus::formats::sweep {

/// Philox4x32-10: a bijection of the counter, keyed. Salmon, Moraes, Dror and Shaw, "Parallel random numbers:
/// as easy as 1, 2, 3", SC 2011.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// Names a stream by what it is drawn for ("joint.default.friction_deg"), so that adding one variable leaves
/// the numbers of the others alone. FNV-1a, 64 bits.
std::uint64_t streamOf(std::string_view name);

/// 64 random bits.
std::uint64_t bits(std::uint64_t seed, std::uint64_t stream, std::uint64_t number);

/// Uniform, never 0 and never 1: the middles of 2^52 equal cells.
double uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t number);

/// A random permutation of 0..count-1, evaluated at one place without listing it: a Feistel network over the
/// next power of four, repeated until the value is below `count`. \pre index < count
std::uint64_t permuted(std::uint64_t index, std::uint64_t count, std::uint64_t seed, std::uint64_t stream);

/// Sample `index` of a Latin hypercube of `count` samples, in the dimension of this stream. Each of `count`
/// equal cells of (0, 1) is hit once, anywhere inside it.
double latinHypercube(std::uint64_t index, std::uint64_t count, std::uint64_t seed, std::uint64_t stream);

}  // namespace talus::formats::sweep
