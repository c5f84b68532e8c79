#include "sweep/random.h"

#include <algorithm>

namespace talus::formats::sweep {

namespace {

constexpr std::uint32_t low(std::uint64_t value) { return static_cast<std::uint32_t>(value); }
constexpr std::uint32_t high(std::uint64_t value) { return static_cast<std::uint32_t>(value >> 32); }

// Two kinds of streams for one variable: its numbers, and the permutation of its Latin hypercube.
constexpr std::uint64_t kPermutationStream = 0x9e3779b97f4a7c15;
constexpr int kFeistelRounds = 6;

}  // namespace

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t even = std::uint64_t{0xD2511F53} * counter[0];
        const std::uint64_t odd = std::uint64_t{0xCD9E8D57} * counter[2];
        counter = {high(odd) ^ counter[1] ^ key[0], low(odd), high(even) ^ counter[3] ^ key[1], low(even)};
        key[0] += 0x9E3779B9;
        key[1] += 0xBB67AE85;
    }
    return counter;
}

std::uint64_t streamOf(std::string_view name) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return hash;
}

std::uint64_t bits(std::uint64_t seed, std::uint64_t stream, std::uint64_t number) {
    const auto words =
        philox({low(number), high(number), low(stream), high(stream)}, {low(seed), high(seed)});
    return (std::uint64_t{words[1]} << 32) | words[0];
}

double uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t number) {
    // 52 bits and a half: the largest is 1 - 2^-53, which a double holds; with 53 bits it would round to 1.
    return (static_cast<double>(bits(seed, stream, number) >> 12) + 0.5) * 0x1p-52;
}

std::uint64_t permuted(std::uint64_t index, std::uint64_t count, std::uint64_t seed, std::uint64_t stream) {
    int half = 1;
    while (half < 32 && (std::uint64_t{1} << (2 * half)) < count) ++half;
    const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
    do {
        std::uint64_t left = index >> half, right = index & mask;
        for (int round = 0; round < kFeistelRounds; ++round) {
            const std::uint64_t number = (static_cast<std::uint64_t>(round) << 32) | right;
            const std::uint64_t mixed = left ^ (bits(seed, stream ^ kPermutationStream, number) & mask);
            left = right;
            right = mixed;
        }
        index = (left << half) | right;
    } while (index >= count);
    return index;
}

double latinHypercube(std::uint64_t index, std::uint64_t count, std::uint64_t seed, std::uint64_t stream) {
    const auto cell = static_cast<double>(permuted(index, count, seed, stream));
    const double value = (cell + uniform(seed, stream, index)) / static_cast<double>(count);
    return std::min(value, 1 - 0x1p-53);  // the last cell's end may round to 1
}

}  // namespace talus::formats::sweep
