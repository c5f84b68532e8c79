#include "law/law.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

using talus::contact::JointLaw;
using talus::contact::PointForce;
using talus::contact::PointMemory;

namespace {

// k_n = 2e9 Pa/m, k_s = 1e9 Pa/m, tan(phi) = 0.5; a contact point of 0.01 m2 then has 2e7 and 1e7 N/m.
constexpr double kArea = 0.01;

PointForce contactLaw(const JointLaw& law, double area, double gap, double slide_1, double slide_2,
                      double release, PointMemory& memory) {
    return talus::contact::contactLaw(law, area, gap, slide_1, slide_2, release, memory);
}

JointLaw friction() {
    JointLaw joint;
    joint.normal_stiffness = 2e9;
    joint.shear_stiffness = 1e9;
    joint.tan_friction = joint.residual_tan_friction = 0.5;
    return joint;
}

JointLaw cohesive() {
    JointLaw joint = friction();
    joint.cohesion = 1e5;          // 1000 N on the contact point
    joint.tensile_strength = 5e4;  // 500 N
    joint.bonded = true;
    return joint;
}

}  // namespace

TEST_SUITE("law") {
    TEST_CASE(
        "normal force is k_n A times the overlap (eq 5), and nothing when "
        "open (eqs 7-8)") {
        PointMemory memory;
        CHECK(contactLaw(friction(), kArea, -1e-5, 0, 0, 1, memory).normal == doctest::Approx(200));
        const PointForce open = contactLaw(friction(), kArea, 1e-9, 1e-3, 0, 1, memory);
        CHECK(open.open);
        CHECK(open.normal == 0);
        CHECK(open.shear_1 == 0);
    }

    TEST_CASE("shear force is k_s A times the slide (eq 6) and opposes it") {
        PointMemory memory;
        const PointForce force = contactLaw(friction(), kArea, -1e-5, 3e-6, -4e-6, 1, memory);
        CHECK(force.shear_1 == doctest::Approx(-30));
        CHECK(force.shear_2 == doctest::Approx(40));
        CHECK_FALSE(force.slips);
    }

    TEST_CASE("beyond F_n tan(phi) it slips, along the trial direction (eq 9)") {
        PointMemory memory;
        const PointForce force = contactLaw(friction(), kArea, -1e-5, 3e-5, -4e-5, 1, memory);
        CHECK(force.slips);
        CHECK(force.shear_1 == doctest::Approx(-60));  // 100 N along (3, -4) / 5
        CHECK(force.shear_2 == doctest::Approx(80));
        SUBCASE(
            "and what has slipped stays: back at zero slide the force points "
            "the other way") {
            const PointForce back = contactLaw(friction(), kArea, -1e-5, 2.4e-5, -3.2e-5, 1, memory);
            CHECK_FALSE(back.slips);
            CHECK(back.shear_1 == doctest::Approx(0).epsilon(1e-9));
        }
    }

    TEST_CASE("a closed cycle of slide gives the Coulomb loop's work") {
        // Amplitude d, elastic limit d_e: dissipated 4 F (d - d_e) per cycle.
        PointMemory memory;
        const double d = 5e-5, limit = 100, elastic = 1e-5;
        double work = 0, last_slide = 0, last_force = 0;
        const int n = 4000;
        for (int k = 0; k <= 5 * n / 4; ++k) {
            const double slide = d * std::sin(2 * M_PI * k / n);
            const PointForce force = contactLaw(friction(), kArea, -1e-5, slide, 0, 1, memory);
            if (k > n / 4) work -= 0.5 * (force.shear_1 + last_force) * (slide - last_slide);
            last_slide = slide;
            last_force = force.shear_1;
        }
        CHECK(work == doctest::Approx(4 * limit * (d - elastic)).epsilon(1e-4));
    }

    TEST_CASE("an intact Lp carries tension up to its strength, then opens for good") {
        PointMemory memory;
        const PointForce pulled = contactLaw(cohesive(), kArea, 2.4e-5, 0, 0, 1, memory);
        CHECK(pulled.normal == doctest::Approx(-480));
        CHECK_FALSE(pulled.open);
        CHECK(memory.bond == 1);
        const PointForce torn = contactLaw(cohesive(), kArea, 2.6e-5, 0, 0, 1, memory);
        CHECK(torn.open);
        CHECK(torn.normal == 0);
        CHECK(memory.bond == 0);
        CHECK(contactLaw(cohesive(), kArea, 1e-6, 0, 0, 1, memory).open);
        SUBCASE("closing again brings compression and friction, but no cohesion") {
            contactLaw(cohesive(), kArea, -1e-5, 0, 0, 1, memory);
            const PointForce force = contactLaw(cohesive(), kArea, -1e-5, 1e-3, 0, 1, memory);
            CHECK(force.normal == doctest::Approx(200));
            CHECK(force.shear_1 == doctest::Approx(-100));
        }
    }

    TEST_CASE("tension lowers the shear strength of an intact Lp") {
        PointMemory memory;
        CHECK(talus::contact::shearStrength(cohesive(), kArea, -400.0, 1.0) == doctest::Approx(800));
        contactLaw(cohesive(), kArea, 2e-5, 7.9e-5, 0, 1, memory);
        CHECK(memory.bond == 1);
        const PointForce broken = contactLaw(cohesive(), kArea, 2e-5, 8.1e-5, 0, 1, memory);
        CHECK(memory.bond == 0);
        CHECK(broken.shear_1 == 0);
    }

    TEST_CASE(
        "brittle cohesion: peak C A + F_n tan(phi), then C_r A + F_n "
        "tan(phi_r)") {
        JointLaw joint = cohesive();
        joint.residual_cohesion = 2e4;       // 200 N
        joint.residual_tan_friction = 0.25;  // 50 N at 200 N
        PointMemory memory;
        CHECK(contactLaw(joint, kArea, -1e-5, 1.09e-4, 0, 1, memory).shear_1 == doctest::Approx(-1090));
        CHECK(contactLaw(joint, kArea, -1e-5, 1.11e-4, 0, 1, memory).shear_1 == doctest::Approx(-250));
        CHECK(contactLaw(joint, kArea, -1e-5, 2e-4, 0, 1, memory).shear_1 == doctest::Approx(-250));
    }

    TEST_CASE("a break is released in as many calls as `release` says") {
        PointMemory memory;
        double last = contactLaw(cohesive(), kArea, -1e-5, 1.2e-4, 0, 0.1, memory).shear_1;
        CHECK(last == doctest::Approx(-1000));  // 0.9 of the cohesion is left, and 100 N of friction
        for (int k = 0; k < 9; ++k) {
            const double now = contactLaw(cohesive(), kArea, -1e-5, 1.2e-4, 0, 0.1, memory).shear_1;
            CHECK(now == doctest::Approx(last + 100));
            last = now;
        }
        CHECK(memory.bond == doctest::Approx(0).epsilon(1e-12));
    }

    TEST_CASE(
        "unbonded Lps keep their peak friction when they open, and lose it "
        "when they slip") {
        JointLaw joint = friction();
        joint.residual_tan_friction = 0.25;
        PointMemory memory;
        contactLaw(joint, kArea, 1e-5, 0, 0, 1, memory);
        CHECK(memory.bond == 1);
        CHECK(contactLaw(joint, kArea, -1e-5, 1e-3, 0, 1, memory).shear_1 == doctest::Approx(-50));
        CHECK(memory.bond == 0);
    }

    TEST_CASE("dilation opens by slip times tan(psi)") {
        JointLaw joint = friction();
        joint.tan_dilation = 0.1;
        PointMemory memory;
        contactLaw(joint, kArea, -1e-5, 3e-5, 0, 1, memory);  // elastic 1e-5, slips 2e-5
        CHECK(memory.dilation == doctest::Approx(2e-6));
        CHECK(contactLaw(joint, kArea, -1e-5, 2e-5, 0, 1, memory).normal == doctest::Approx(240));
    }

    TEST_CASE("a joint that softens takes sigma_t (sigma_t / k_n + w) / 2 a square metre to tear") {
        for (const double way : {1e-6, 2e-5, 1e-3})
            for (const double strength : {1e3, 5e4}) {
                CAPTURE(way);
                CAPTURE(strength);
                JointLaw joint = cohesive();
                joint.tensile_strength = strength;
                joint.softening = way;
                PointMemory memory;
                const double closed = strength / joint.normal_stiffness, end = closed + way;
                const int n = 20000;
                double work = 0, last = 0;
                for (int k = 1; k <= n; ++k) {
                    const double now = contactLaw(joint, kArea, 1.01 * end * k / n, 0, 0, 1, memory).normal;
                    work -= 0.5 * (now + last) * (1.01 * end / n);
                    last = now;
                }
                CHECK(work == doctest::Approx(kArea * strength * end / 2).epsilon(1e-3));
                CHECK(last == 0);
                CHECK(memory.bond == 0);
            }
    }

    TEST_CASE("a joint that softens closes where it was closed, and gives back what its springs hold") {
        JointLaw joint = cohesive();
        joint.softening = 4e-5;
        PointMemory memory;
        const PointForce half = contactLaw(joint, kArea, 2.5e-5 + 2e-5, 0, 0, 1, memory);
        CHECK(memory.bond == doctest::Approx(0.5));
        CHECK(half.normal == doctest::Approx(-250));
        CHECK(talus::contact::storedEnergy(joint, kArea, memory.bond, half) ==
              doctest::Approx(0.5 * 250 * 4.5e-5));
        CHECK(contactLaw(joint, kArea, 0.5 * 4.5e-5, 0, 0, 1, memory).normal == doctest::Approx(-125));
        CHECK(contactLaw(joint, kArea, -1e-5, 0, 0, 1, memory).normal == doctest::Approx(200));
        CHECK(contactLaw(joint, kArea, 4.5e-5, 0, 0, 1, memory).normal == doctest::Approx(-250));
        CHECK(memory.bond == doctest::Approx(0.5));
    }

    TEST_CASE("a joint that softens loses its peak along a straight line as it slips, in steps of any size") {
        JointLaw joint = cohesive();
        joint.residual_cohesion = 2e4;
        joint.residual_tan_friction = 0.25;
        joint.softening = 3e-4;
        // 100 N of friction and 1000 N of cohesion: slips beyond 1.1e-4 m; 50 and 200 N are left.
        for (const int steps : {1, 7, 1000}) {
            PointMemory memory;
            double force = 0;
            for (int k = 1; k <= steps; ++k)
                force = contactLaw(joint, kArea, -1e-5, (1.1e-4 + 2e-4) * k / steps, 0, 1, memory).shear_1;
            CHECK(memory.bond == doctest::Approx(1.0 / 3));
            CHECK(force == doctest::Approx(-(250 + 850 / 3.0)));
            CHECK(contactLaw(joint, kArea, -1e-5, 1e-2, 0, 1, memory).shear_1 == doctest::Approx(-250));
            CHECK(memory.bond == 0);
        }
    }

    TEST_CASE("a softening joint makes no energy on any path, and a second call changes nothing") {
        std::mt19937 random(3);
        std::normal_distribution<double> gauss(0, 1);
        for (int history = 0; history < 200; ++history) {
            JointLaw joint = cohesive();
            joint.softening = std::pow(10.0, -6 + 3 * std::abs(gauss(random)) / 3);
            PointMemory memory;
            double gap = 0, slide = 0, work = 0, dissipated = 0, largest = 0;
            PointForce last;
            for (int walk = 0; walk < 20; ++walk) {
                const double to_gap = 4e-5 * gauss(random), to_slide = 1e-4 * gauss(random);
                const int n = 2000;
                const double by_gap = (to_gap - gap) / n, by_slide = (to_slide - slide) / n;
                for (int k = 0; k < n; ++k) {
                    gap += by_gap, slide += by_slide;
                    const PointForce now = contactLaw(joint, kArea, gap, slide, 0, 1, memory);
                    work -= 0.5 * (now.normal + last.normal) * by_gap +
                            0.5 * (now.shear_1 + last.shear_1) * by_slide;
                    last = now;
                    const double stored = talus::contact::storedEnergy(joint, kArea, memory.bond, now);
                    largest = std::max(largest, stored);
                    REQUIRE(work - stored > dissipated - 1e-3 * largest);
                    dissipated = std::max(dissipated, work - stored);
                }
                const PointMemory before = memory;
                const PointForce again = contactLaw(joint, kArea, gap, slide, 0, 1, memory);
                CHECK(again.normal == doctest::Approx(last.normal).epsilon(1e-9));
                CHECK(again.shear_1 == doctest::Approx(last.shear_1).epsilon(1e-9));
                CHECK(memory.bond == doctest::Approx(before.bond).epsilon(1e-9));
            }
        }
    }

    TEST_CASE("an open Lp forgets its shear") {
        PointMemory memory;
        contactLaw(friction(), kArea, -1e-5, 1e-6, 0, 1, memory);
        contactLaw(friction(), kArea, 1e-5, 5e-6, 0, 1, memory);
        CHECK(contactLaw(friction(), kArea, -1e-5, 6e-6, 0, 1, memory).shear_1 == doctest::Approx(-10));
    }
}
