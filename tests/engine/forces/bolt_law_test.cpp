#include "forces/bolt_law.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace talus;

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// 100 N at 1 mm, of a bar of 1 m; the weaker of yield and bond is what it holds.
BoltLaw lawOf(double yield, double bond, double pretension = 0) {
    return {.stiffness = 1e5,
            .rigidity = 1e5,
            .pretension = pretension,
            .yield = yield,
            .bond = bond,
            .rupture_strain = kNever,
            .dowel_stiffness = 2e4,
            .dowel_strength = 40};
}

}  // namespace

TEST_SUITE("forces") {
    TEST_CASE(
        "a bar in grout: the solution of E A w'' = k_b w by finite differences, free or held by a plate") {
        const double rigidity = 181e-6 * 98.6e9, bond = 112e6;
        for (const double length : {0.1, 0.7, 3.0})
            for (const bool plate : {false, true}) {
                // Tridiagonal, n pieces: w = 1 where it is pulled; the other end is free, or does not move.
                constexpr int n = 4000;
                const double h = length / n, off = rigidity / h;
                std::vector<double> diagonal(n + 1, 2 * off + bond * h), right(n + 1, 0.0);
                diagonal[n] = off + 0.5 * bond * h;
                const int last = plate ? n - 1 : n;
                right[1] = off;
                for (int k = 2; k <= last; ++k) {
                    const double share = off / diagonal[k - 1];
                    diagonal[k] -= share * off;
                    right[k] += share * right[k - 1];
                }
                double w = 0;
                for (int k = last; k >= 1; --k) w = (right[k] + (k < last ? off * w : 0.0)) / diagonal[k];
                const double pull = off * (1 - w) + 0.5 * bond * h;
                CHECK(bolt::embeddedStiffness(rigidity, bond, length, plate) ==
                      doctest::Approx(pull).epsilon(1e-5));
            }
    }

    TEST_CASE("initial stiffness of a grouted cable: 44.7 MN/m for a bond of 17.7 m") {
        const double found = bolt::embeddedStiffness(181e-6 * 98.6e9, 112e6, 17.7, false);
        MESSAGE("initial stiffness ", found / 1e6, " MN/m, reference 44.7");
        CHECK(found == doctest::Approx(44.7e6).epsilon(1e-3));
        CHECK(bolt::inSeries(found, found) == doctest::Approx(0.5 * found));
    }

    TEST_CASE("elastic to its strength, then the force stays and unloading is elastic") {
        const BoltLaw law = lawOf(80, 200);
        BoltMemory memory;
        CHECK(bolt::axialForce(law, 0.0005, 1, memory).force == doctest::Approx(50));
        CHECK(bolt::axialForce(law, 0.0005, 1, memory).slope == 1e5);
        CHECK(memory.yielded == 0);
        CHECK(bolt::axialForce(law, 0.002, 1, memory).force == 80);
        CHECK(memory.yielded == doctest::Approx(0.0012));
        CHECK(memory.slipped == 0);
        CHECK(bolt::axialForce(law, 0.0015, 1, memory).force == doctest::Approx(30));
        CHECK(bolt::axialForce(law, 0.0011, 1, memory).force == 0);  // slack
        CHECK(bolt::axialForce(law, 0.0018, 1, memory).force == doctest::Approx(60));
        CHECK(memory.yielded == doctest::Approx(0.0012));
    }

    TEST_CASE(
        "where the grout is weaker it slips and the bar does not yield; a pretension is held beside it") {
        const BoltLaw law = lawOf(80, 30, 20);
        BoltMemory memory;
        CHECK(bolt::axialForce(law, 0, 1, memory).force == 20);
        CHECK(bolt::axialForce(law, 0, 0.5, memory).force == 10);  // comes with the weight
        CHECK(bolt::axialForce(law, 0.001, 1, memory).force == 50);
        CHECK(memory.slipped == doctest::Approx(0.0007));
        CHECK(memory.yielded == 0);
    }

    TEST_CASE("it breaks at its strain, elastic and yielded, and then carries nothing") {
        BoltLaw law = lawOf(80, kNever);
        law.rupture_strain = 0.002;
        BoltMemory memory;
        bolt::axialForce(law, 0.0019, 1, memory);
        CHECK(!memory.broken);
        CHECK(bolt::axialForce(law, 0.0021, 1, memory).force == 80);
        CHECK(memory.broken);
        CHECK(bolt::axialForce(law, 0.0021, 1, memory).force == 0);
        CHECK(bolt::dowelForce(law, Vec3::UnitX(), {0, 0.001, 0}, memory).force == Vec3::Zero());
    }

    TEST_CASE("dowel action: elastic across the bolt to its strength, then plastic along its displacement") {
        const BoltLaw law = lawOf(80, kNever);
        BoltMemory memory;
        CHECK((bolt::dowelForce(law, Vec3::UnitX(), {0, 0.001, 0}, memory).force - Vec3(0, -20, 0)).norm() <
              1e-12);
        const bolt::DowelForce slides = bolt::dowelForce(law, Vec3::UnitX(), {0, 0.004, 0.003}, memory);
        CHECK((slides.force + 40 * Vec3(0, 0.8, 0.6)).norm() < 1e-12);
        CHECK((memory.dowel - Vec3(0, 0.0024, 0.0018)).norm() < 1e-12);
        // minus the derivative: nothing along the way, the force turns with it
        CHECK((slides.slope * Vec3(0, 0.8, 0.6)).norm() < 1e-9);
        CHECK((slides.slope * Vec3(0, -0.6, 0.8)).norm() == doctest::Approx(40 / 0.005));
    }
}
