#include "flow/cubic_law.h"

#include <doctest/doctest.h>

using namespace talus::flow;

TEST_CASE("cubic law: a tenth of a millimetre of water") {
    CHECK(transmissivity(9810, 1e-4, 1e-3) == doctest::Approx(8.175e-7).epsilon(1e-12));
    CHECK(transmissivity(9810, 2e-4, 1e-3) == doctest::Approx(8 * 8.175e-7).epsilon(1e-12));
}

TEST_CASE("cubic law: 1/T of a path between walls that part linearly is the mean of 1/T along it") {
    constexpr int kParts = 4000;
    for (const double to : {0.3e-4, 0.9e-4, 1e-4, 1.1e-4, 5e-4}) {
        CAPTURE(to);
        double mean = 0;
        for (int k = 0; k < kParts; ++k)
            mean += 1 / transmissivity(9810, 1e-4 + (to - 1e-4) * (k + 0.5) / kParts, 1.3e-3) / kParts;
        CHECK(taperedTransmissivity(9810, 1e-4, to, 1.3e-3) == doctest::Approx(1 / mean).epsilon(1e-5));
        CHECK(taperedTransmissivity(9810, to, 1e-4, 1.3e-3) ==
              doctest::Approx(taperedTransmissivity(9810, 1e-4, to, 1.3e-3)).epsilon(1e-14));
    }
    CHECK(taperedTransmissivity(9810, 1e-4, 1e-4, 1.3e-3) == transmissivity(9810, 1e-4, 1.3e-3));
}

TEST_CASE("hydraulic aperture: it follows the opening, between the residual one and ten times the stated") {
    CHECK(hydraulicAperture(1e-4, 0, 0.1) == 1e-4);
    CHECK(hydraulicAperture(1e-4, 5e-5, 0.1) == doctest::Approx(1.5e-4).epsilon(1e-12));
    CHECK(hydraulicAperture(1e-4, -5e-5, 0.1) == doctest::Approx(5e-5).epsilon(1e-12));
    CHECK(hydraulicAperture(1e-4, -1, 0.1) == doctest::Approx(1e-5).epsilon(1e-12));
    CHECK(hydraulicAperture(1e-4, 1, 0.1) == doctest::Approx(1e-3).epsilon(1e-12));
}

TEST_CASE(
    "relative conductivity: full under pressure, a half at the ramp, what a dry joint keeps far above") {
    constexpr double kRamp = 0.04, kDry = 1e-5;
    const auto at = [](double pressure_head) {
        return relativeConductivity(pressure_head, kRamp, kDry).value;
    };
    CHECK(at(2) == 1);
    CHECK(at(0) == 1);
    CHECK(at(-kRamp) == doctest::Approx((1 + kDry) / 2).epsilon(1e-12));
    CHECK(at(-1e6) == doctest::Approx(kDry).epsilon(1e-6));
}

TEST_CASE("relative conductivity: its slope, by differences, also where pressure ends") {
    constexpr double kRamp = 0.04, kStep = 1e-7;
    for (const double p : {-1.0, -0.1, -0.04, -0.01, 0.0, 0.5}) {
        CAPTURE(p);
        const double slope = (relativeConductivity(p + kStep, kRamp, 1e-5).value -
                              relativeConductivity(p - kStep, kRamp, 1e-5).value) /
                             (2 * kStep);
        CHECK(relativeConductivity(p, kRamp, 1e-5).slope == doctest::Approx(slope).epsilon(1e-4));
    }
}
