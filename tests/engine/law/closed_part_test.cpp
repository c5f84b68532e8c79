// Pressure over the closed part of a triangle against a sum over small triangles, and what its contact points
// carry.

#include "law/closed_part.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "law/points.h"

using namespace talus;

namespace {

using Overlaps = std::array<double, 3>;

contact::ClosedPart partOf(const Overlaps& o) { return contact::closedPart({o[0], o[1], o[2]}); }
contact::TriangleShares sharesOf(const Overlaps& o) { return contact::sharesOf({o[0], o[1], o[2]}); }

/// Of what a function gives for the overlap, with each shape function: by sums over the middles of n^2 equal
/// triangles.
Overlaps summed(const Overlaps& overlap, int n, double (*of)(double)) {
    Overlaps sum{};
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n - i; ++j)
            for (int flipped = 0; flipped < (j + 1 < n - i ? 2 : 1); ++flipped) {
                const double third = (1 + flipped) / 3.0;
                const Overlaps shape{(i + third) / n, (j + third) / n, 1 - (i + j + 2 * third) / n};
                const double here = shape[0] * overlap[0] + shape[1] * overlap[1] + shape[2] * overlap[2];
                for (std::size_t k = 0; k < 3; ++k) sum[k] += shape[k] * of(here) / (n * n);
            }
    return sum;
}

double positivePart(double x) { return std::max(x, 0.0); }
double isPositive(double x) { return x > 0 ? 1.0 : 0.0; }

/// Exact but for the rounding of long double: the whole triangle less its open tip at corner 2.
Overlaps besideTip(const Overlaps& overlap) {
    const long double o0 = overlap[0], o1 = overlap[1], o2 = overlap[2];
    const long double s = o2 / (o2 - o0), t = o2 / (o2 - o1), area = s * t / 12;
    const long double all = o0 + o1 + o2;
    return {static_cast<double>((o0 + all) / 12 - area * o2 * s),
            static_cast<double>((o1 + all) / 12 - area * o2 * t),
            static_cast<double>((o2 + all) / 12 - area * o2 * ((1 - s) + (1 - t) + 2))};
}

Overlaps drawn(std::mt19937& random) {
    std::uniform_real_distribution<double> both(-1, 1);
    return {both(random), both(random), both(random)};
}

}  // namespace

TEST_SUITE("law") {
    TEST_CASE("closed part of a triangle: its integrals, wherever the zero line runs") {
        std::mt19937 random(5);
        for (int trial = 0; trial < 200; ++trial) {
            Overlaps overlap = drawn(random);
            if (trial % 5 == 0) overlap[0] = 0;
            if (trial % 10 == 0) overlap[1] = 0;
            const Overlaps exact = summed(overlap, 300, positivePart);
            const contact::ClosedPart part = partOf(overlap);
            for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(part.by_corner[k] - exact[k]) < 2e-6);
        }
    }

    TEST_CASE("closed part of a triangle: of a narrow strip along a side every digit") {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> part(0.1, 1);
        for (int trial = 0; trial < 200; ++trial) {
            const Overlaps overlap{1e-3 * part(random), 1e-3 * part(random), -part(random)};
            const Overlaps exact = besideTip(overlap);
            const contact::ClosedPart found = partOf(overlap);
            // That at the open corner is smaller, and the reference rounds it more.
            for (const std::size_t k : {0, 1})
                CHECK(found.by_corner[k] == doctest::Approx(exact[k]).epsilon(1e-12).scale(0));
            CHECK(found.by_corner[2] == doctest::Approx(exact[2]).epsilon(1e-7).scale(0));
        }
    }

    TEST_CASE("what a triangle's points carry: no tension, the same force and moments, the rates of both") {
        constexpr double kStep = 1e-6;
        std::mt19937 random(6);
        for (int trial = 0; trial < 500; ++trial) {
            const Overlaps overlap = drawn(random);
            const contact::ClosedPart part = partOf(overlap);
            const contact::TriangleShares shares = sharesOf(overlap);
            for (const double carried : shares.overlap) CHECK(carried >= 0);
            for (std::size_t k = 0; k < 3; ++k)
                CHECK(shares.overlap[k] + shares.overlap[3] / 3 ==
                      doctest::Approx(part.by_corner[k]).epsilon(1e-12).scale(1));
            for (std::size_t j = 0; j < 3; ++j) {
                Overlaps more = overlap, less = overlap;
                more[j] += kStep;
                less[j] -= kStep;
                const contact::TriangleShares up = sharesOf(more), down = sharesOf(less);
                for (std::size_t k = 0; k < 4; ++k)
                    CHECK(std::abs((up.overlap[k] - down.overlap[k]) / (2 * kStep) - shares.rate[k][j]) <
                          1e-4);
            }
        }
    }

    TEST_CASE("the closed area of a triangle, its points' shares of that, and the rates of both") {
        constexpr double kStep = 1e-6;
        std::mt19937 random(8);
        for (int trial = 0; trial < 500; ++trial) {
            const Overlaps overlap = drawn(random);
            const contact::ClosedPart part = partOf(overlap);
            const contact::TriangleShares shares = sharesOf(overlap);
            if (trial < 100) {
                const Overlaps exact = summed(overlap, 300, isPositive);
                for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(part.area[k] - exact[k]) < 2e-3);
            }
            for (const double closed : shares.closed) CHECK(closed >= 0);
            for (std::size_t k = 0; k < 3; ++k)
                CHECK(shares.closed[k] + shares.closed[3] / 3 ==
                      doctest::Approx(part.area[k]).epsilon(1e-12).scale(1));
            for (std::size_t j = 0; j < 3; ++j) {
                Overlaps more = overlap, less = overlap;
                more[j] += kStep;
                less[j] -= kStep;
                const contact::TriangleShares up = sharesOf(more), down = sharesOf(less);
                for (std::size_t k = 0; k < 4; ++k)
                    CHECK(std::abs((up.closed[k] - down.closed[k]) / (2 * kStep) - shares.closed_rate[k][j]) <
                          1e-3 * (1 + std::abs(shares.closed_rate[k][j])));
            }
        }
    }

    TEST_CASE("a closed triangle has what the rule \"vertex\" gives it") {
        std::mt19937 random(7);
        for (int trial = 0; trial < 100; ++trial) {
            Overlaps overlap = drawn(random);
            for (double& o : overlap) o = std::abs(o);
            const contact::TriangleShares shares = sharesOf(overlap);
            for (std::size_t k = 0; k < 3; ++k)
                CHECK(shares.overlap[k] == doctest::Approx(overlap[k] / 12).epsilon(1e-12));
            CHECK(shares.overlap[3] ==
                  doctest::Approx(0.75 * (overlap[0] + overlap[1] + overlap[2]) / 3).epsilon(1e-12));
        }
    }

    TEST_CASE("an open triangle carries nothing") {
        for (const double carried : sharesOf({-1, -0.5, -1e-9}).overlap) CHECK(carried == 0);
    }
}
