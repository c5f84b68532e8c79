// The cubic law of a leak, and the volume it leaves.

#include "forces/leak.h"

#include <doctest/doctest.h>

#include <initializer_list>

#include "support/relative.h"

using namespace talus;
using namespace talus::test;

TEST_SUITE("engine") {
    TEST_CASE("leak: the cubic law by hand") {
        // 9810 N/m3 (1e-4 m)^3 / (12 * 1e-3 Pa s) = 8.175e-7 m2/s, under 2 m over 4 m.
        const Leak leak{1e-4, 4, 9810};
        CHECK(leak.under(2) == near(0.5 * 8.175e-7, 1e-14));
        CHECK(leak.under(0) == 0);
        CHECK(Leak{2e-4, 4, 9810}.under(2) == near(8 * leak.under(2), 1e-14));
        CHECK(Leak{0, 4, 9810}.under(2) == 0);
    }

    TEST_CASE("leak: the volume left is that of dV/dt = Q - k V, in one step as in many") {
        constexpr double kVolume = 3, kGain = 0.8, kRate = 0.7, kTime = 2;
        const double at_once = volumeLeft(kVolume, kGain, kRate, kTime);
        double euler = kVolume;
        constexpr int kParts = 1000000;
        for (int k = 0; k < kParts; ++k) euler += (kGain / kTime - kRate * euler) * kTime / kParts;
        CHECK(at_once == near(euler, 1e-6));
        double stepped = kVolume;
        for (int k = 0; k < 7; ++k) stepped = volumeLeft(stepped, kGain / 7, kRate, kTime / 7);
        CHECK(stepped == near(at_once, 1e-14));
    }

    TEST_CASE("leak: no rate leaves everything, and no step less than nothing") {
        CHECK(volumeLeft(3, 0.8, 0, 2) == 3.8);
        CHECK(volumeLeft(3, 0.8, 1e-300, 2) == 3.8);
        for (const double rate : {1e3, 1e6, 1e300}) {
            CAPTURE(rate);
            CHECK(volumeLeft(3, 0, rate, 2) >= 0);
            CHECK(volumeLeft(3, 0.8, rate, 2) == near(0.8 / (2 * rate), 1e-12));
        }
    }
}
