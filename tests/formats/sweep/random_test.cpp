// The generator against its authors' known answers, uniformity, permutations and Latin hypercubes.

#include "sweep/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace talus::formats::sweep {

namespace {

using Words = std::array<std::uint32_t, 4>;

}  // namespace

TEST_CASE("Philox4x32-10 gives the known answers of Random123") {
    CHECK(philox({0, 0, 0, 0}, {0, 0}) == Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
    const std::uint32_t ones = 0xffffffff;
    CHECK(philox({ones, ones, ones, ones}, {ones, ones}) ==
          Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
    CHECK(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
          Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("FNV-1a gives its known answers") {
    CHECK(streamOf("") == 0xcbf29ce484222325);
    CHECK(streamOf("a") == 0xaf63dc4c8601ec8c);
    CHECK(streamOf("foobar") == 0x85944171f73967e8);
}

TEST_CASE("uniform numbers fill (0, 1) evenly and streams do not follow each other") {
    constexpr int kCount = 20000;
    std::vector<double> cells(20, 0);
    double sum = 0, product = 0;
    for (int i = 0; i < kCount; ++i) {
        const double u = uniform(1, streamOf("a"), i), v = uniform(1, streamOf("b"), i);
        CHECK_UNARY(u > 0 && u < 1);
        ++cells[static_cast<std::size_t>(20 * u)];
        sum += u;
        product += (u - 0.5) * (v - 0.5);
    }
    double chi_square = 0;
    for (const double cell : cells) chi_square += std::pow(cell - kCount / 20.0, 2) / (kCount / 20.0);
    CHECK(chi_square < 43.8);  // 99.9 % of chi-square with 19 degrees of freedom
    CHECK(sum / kCount == doctest::Approx(0.5).epsilon(0.02));
    CHECK(std::abs(12 * product / kCount) < 0.03);
}

TEST_CASE("permutations hit every number once and differ by stream and seed") {
    for (const std::uint64_t count : {1, 2, 3, 7, 64, 1000, 4097}) {
        std::set<std::uint64_t> seen;
        std::uint64_t fixed = 0, same = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint64_t place = permuted(i, count, 5, 9);
            CHECK(place < count);
            seen.insert(place);
            fixed += place == i;
            same += place == permuted(i, count, 5, 10);
        }
        CAPTURE(count);
        CHECK(seen.size() == count);
        if (count >= 64) CHECK(std::max(fixed, same) < 12);  // one on average
    }
}

TEST_CASE("a Latin hypercube has one sample in each cell") {
    constexpr std::uint64_t kCount = 500;
    std::set<std::uint64_t> cells;
    double sum = 0;
    for (std::uint64_t i = 0; i < kCount; ++i) {
        const double u = latinHypercube(i, kCount, 3, streamOf("x"));
        cells.insert(static_cast<std::uint64_t>(u * kCount));
        sum += u;
    }
    CHECK(cells.size() == kCount);
    CHECK(sum / kCount == doctest::Approx(0.5).epsilon(1e-3));  // independent samples scatter by 0.013
}

}  // namespace talus::formats::sweep
