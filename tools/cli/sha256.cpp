#include "cli/sha256.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace talus::tools {

namespace {

using Words = std::array<std::uint32_t, 8>;

/// The first 32 bits of the fractional part of a root of a prime.
std::uint32_t fractionOf(long double root) {
    return static_cast<std::uint32_t>((root - std::floor(root)) * 4294967296.0L);
}

/// Of the square roots of the first eight primes the state at the start; of the cube roots of the first 64
/// the constants of the rounds.
struct Constants {
    Words start{};
    std::array<std::uint32_t, 64> round{};

    Constants() {
        std::size_t count = 0;
        for (int n = 2; count < round.size(); ++n) {
            bool is_prime = true;
            for (int d = 2; d * d <= n; ++d) is_prime = is_prime && n % d != 0;
            if (!is_prime) continue;
            const auto prime = static_cast<long double>(n);
            if (count < start.size()) start[count] = fractionOf(std::sqrt(prime));
            round[count++] = fractionOf(std::cbrt(prime));
        }
    }
};

void addBlock(const unsigned char* bytes, const Constants& constants, Words& state) {
    std::array<std::uint32_t, 64> w{};
    for (std::size_t t = 0; t < 16; ++t)
        for (std::size_t k = 0; k < 4; ++k) w[t] = w[t] << 8U | bytes[4 * t + k];
    for (std::size_t t = 16; t < 64; ++t) {
        const std::uint32_t a = w[t - 15], b = w[t - 2];
        w[t] = w[t - 16] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ a >> 3U) + w[t - 7] +
               (std::rotr(b, 17) ^ std::rotr(b, 19) ^ b >> 10U);
    }
    auto [a, b, c, d, e, f, g, h] = state;
    for (std::size_t t = 0; t < 64; ++t) {
        const std::uint32_t first = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                                    ((e & f) ^ (~e & g)) + constants.round[t] + w[t];
        const std::uint32_t second =
            (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
        h = g, g = f, f = e, e = d + first, d = c, c = b, b = a, a = first + second;
    }
    const Words after{a, b, c, d, e, f, g, h};
    for (std::size_t k = 0; k < state.size(); ++k) state[k] += after[k];
}

}  // namespace

std::string sha256(std::string_view bytes) {
    constexpr std::size_t kBlock = 64, kLength = 8;
    static const Constants kConstants;
    std::string padded(bytes);
    padded += '\x80';
    padded.append((2 * kBlock - kLength - padded.size() % kBlock) % kBlock, '\0');
    for (std::size_t k = kLength; k-- > 0;)
        padded += static_cast<char>(static_cast<std::uint64_t>(bytes.size()) * 8U >> 8U * k & 0xffU);
    Words state = kConstants.start;
    for (std::size_t at = 0; at < padded.size(); at += kBlock)
        addBlock(reinterpret_cast<const unsigned char*>(padded.data()) + at, kConstants, state);
    std::string hex;
    for (const std::uint32_t word : state) {
        char digits[9];
        std::snprintf(digits, sizeof digits, "%08x", word);
        hex += digits;
    }
    return hex;
}

}  // namespace talus::tools
