#include "flow/cubic_law.h"

#include <doctest/doctest.h>

#include <random>

using namespace talus::flow;

TEST_CASE("cubic law: a tenth of a millimetre of water") {
    CHECK(transmissivity(9810, 1e-4, 1e-3) == doctest::Approx(8.175e-7).epsilon(1e-12));
    CHECK(transmissivity(9810, 2e-4, 1e-3) == doctest::Approx(8 * 8.175e-7).epsilon(1e-12));
}

TEST_CASE("hydraulic aperture: it follows the opening, between the residual one and ten times the stated") {
    CHECK(hydraulicAperture(1e-4, 0, 0.1) == 1e-4);
    CHECK(hydraulicAperture(1e-4, 5e-5, 0.1) == doctest::Approx(1.5e-4).epsilon(1e-12));
    CHECK(hydraulicAperture(1e-4, -5e-5, 0.1) == doctest::Approx(5e-5).epsilon(1e-12));
    CHECK(hydraulicAperture(1e-4, -1, 0.1) == doctest::Approx(1e-5).epsilon(1e-12));
    CHECK(hydraulicAperture(1e-4, 1, 0.1) == doctest::Approx(1e-3).epsilon(1e-12));
}

TEST_CASE("mean of the positive part over a triangle: against sums over a fine grid") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> between(-1, 1);
    for (int trial = 0; trial < 20; ++trial) {
        const std::array<double, 3> f{between(random), between(random), between(random)};
        constexpr int kParts = 400;
        double sum = 0;
        for (int i = 0; i < kParts; ++i)
            for (int j = 0; i + j < kParts; ++j)
                for (const double third : {1.0 / 3, 2.0 / 3}) {
                    if (third > 0.5 && i + j + 1 >= kParts) continue;
                    const double a = (i + third) / kParts, b = (j + third) / kParts;
                    sum += std::max(0.0, a * f[0] + b * f[1] + (1 - a - b) * f[2]);
                }
        CHECK(meanPositive(f) == doctest::Approx(sum / (kParts * kParts)).epsilon(1e-4));
    }
}

TEST_CASE("wet share: full under pressure, dry above the surface, the area below it between") {
    CHECK(wetShare({0, 1, 2}, 0.1) == 1);
    CHECK(wetShare({-0.2, -1, -2}, 0.1) == 0);
    CHECK(wetShare({-0.05, -0.05, -0.05}, 0.1) == doctest::Approx(0.5));
    // Of a triangle with one corner as deep as the others are high, a quarter is below the surface.
    CHECK(wetShare({1, -1, -1}, 1e-7) == doctest::Approx(0.25).epsilon(1e-5));
    CHECK(wetShare({-1, 1, 1}, 1e-7) == doctest::Approx(0.75).epsilon(1e-5));
}
