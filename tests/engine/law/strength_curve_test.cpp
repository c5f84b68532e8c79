// Laws whose strength is a curve: the table against the formula, the law of a contact point against both.

#include "law/strength_curve.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>

#include "law/joint_laws.h"
#include "law/laws.h"
#include "support/models.h"

namespace talus {
namespace {

using contact::PointForce;
using contact::PointMemory;
using test::radians;

Joint stiffJoint(StrengthLaw law) {
    Joint joint = test::joint(0, 1e10);
    joint.law = law;
    return joint;
}

Joint bartonBandis(double jrc, double jcs, double residual_deg, double max_deg = 70) {
    Joint joint = stiffJoint(StrengthLaw::barton_bandis);
    joint.jrc = jrc;
    joint.jcs = jcs;
    joint.residual_friction = radians(residual_deg);
    joint.max_friction = radians(max_deg);
    return joint;
}

Joint power(double a, double b) {
    Joint joint = stiffJoint(StrengthLaw::power);
    joint.a = a;
    joint.b = b;
    return joint;
}

Joint envelope(std::vector<EnvelopePoint> points) {
    Joint joint = stiffJoint(StrengthLaw::envelope);
    joint.shear_strength = std::move(points);
    return joint;
}

/// The issue's own formula.
double bartonBandisStrength(double jrc, double jcs, double residual_deg, double max_deg, double stress) {
    const double angle = residual_deg + jrc * std::log10(jcs / stress);
    return stress * std::tan(radians(std::min(angle, max_deg)));
}

/// Stresses from 1 Pa to 1 TPa, as many in each decade.
std::vector<double> manyStresses(int count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> decade(0, 12);
    std::vector<double> stresses;
    for (int k = 0; k < count; ++k) stresses.push_back(std::pow(10, decade(random)));
    return stresses;
}

double curveAt(const Joint& joint, double stress) {
    return contact::strengthOnCurve(jointLaws({joint}).front().curve, stress);
}

double largestError(const Joint& joint) {
    const contact::JointLaw law = jointLaws({joint}).front();
    double error = 0;
    for (const double stress : manyStresses(100000)) {
        const double exact = shearStrength(joint, stress);
        error = std::max(error, std::abs(contact::strengthOnCurve(law.curve, stress) / exact - 1));
    }
    return error;
}

const std::vector<EnvelopePoint> kBent{{0, 2e3}, {1e4, 1.2e4}, {1.001e4, 1.2005e4}, {5e5, 2.5e5}, {2e6, 6e5}};

/// Shear force of a contact point far beyond its strength, at an overlap.
PointForce pushed(const Joint& joint, double area, double overlap) {
    const contact::JointLaw law = jointLaws({joint}).front();
    PointMemory memory;
    return contact::contactLaw(law, area, -overlap, 1.0, 0.0, 1.0, memory);
}

TEST_CASE("strength curves: the formulas as they are written") {
    const Joint rough = bartonBandis(8, 5e7, 28);
    for (const double stress : {1e3, 2e4, 1e5, 3e6, 5e7})
        CHECK(shearStrength(rough, stress) ==
              doctest::Approx(bartonBandisStrength(8, 5e7, 28, 70, stress)).epsilon(1e-13));
    CHECK(shearStrength(rough, 1e9) == doctest::Approx(1e9 * std::tan(radians(28))).epsilon(1e-13));
    CHECK(shearStrength(bartonBandis(20, 2e8, 30), 10.0) == doctest::Approx(10 * std::tan(radians(70))));
    CHECK(shearStrength(power(1.2, 0.8), 1e5) == doctest::Approx(1.2 * std::pow(1e5, 0.8)).epsilon(1e-14));
    const Joint bent = envelope({{0, 0}, {1e5, 9e4}, {1e6, 6e5}});
    CHECK(shearStrength(bent, 5e4) == doctest::Approx(4.5e4));
    CHECK(shearStrength(bent, 1e5) == doctest::Approx(9e4));
    CHECK(shearStrength(bent, 5.5e5) == doctest::Approx(3.45e5));
    CHECK(shearStrength(bent, 2e6) == doctest::Approx(6e5 + 1e6 * 5.1e5 / 9e5));
    CHECK(shearStrength(test::joint(30), 100) == doctest::Approx(100 * std::tan(radians(30))));
}

TEST_CASE("strength curves: the table is within 1e-6 of the formula from 1 Pa to 1 TPa") {
    const auto check = [](const Joint& joint, double allowed) {
        const double error = largestError(joint);
        const std::string law(toString(joint.law));
        CAPTURE(law);
        MESSAGE(law << ": " << error);
        CHECK(error < allowed);
    };
    check(bartonBandis(8, 5e7, 28), 1e-7);
    check(bartonBandis(20, 3e8, 35, 80), 1e-6);
    check(bartonBandis(20, 1e5, 10, 80), 1e-6);
    check(bartonBandis(0, 5e7, 28), 1e-11);
    check(power(1.2, 0.8), 1e-7);
    check(power(30, 0.3), 1e-7);
    check(power(0.7, 1), 1e-11);
    check(envelope(kBent), 1e-14);
    check(envelope({{0, 0}, {1e5, 9e4}, {1e6, 6e5}}), 1e-14);
}

TEST_CASE("strength curves: kinks stand where they are, two in one piece of the table too") {
    const Joint joint = envelope(kBent);
    for (const EnvelopePoint& point : kBent) {
        CHECK(curveAt(joint, point.normal_stress) == doctest::Approx(point.shear_strength).epsilon(1e-14));
        for (const double near : {0.999, 1.0001, 1.0004})
            CHECK(curveAt(joint, near * point.normal_stress) ==
                  doctest::Approx(shearStrength(joint, near * point.normal_stress)).epsilon(1e-14));
    }
    // Below 1 Pa a curve goes straight to what it is without normal stress.
    CHECK(curveAt(power(2, 0.5), 0) == 0);
    CHECK(curveAt(power(2, 0.5), 0.25) == doctest::Approx(0.5));
    CHECK(curveAt(power(2, 0.5), 1) == doctest::Approx(2));
    CHECK(std::isfinite(curveAt(power(2, 0.5), 1e300)));
}

TEST_CASE("strength curves: strength grows with the normal stress, and its slope is the curve's") {
    const std::vector<Joint> joints{bartonBandis(8, 5e7, 28), bartonBandis(20, 3e8, 35, 80), power(1.2, 0.8),
                                    envelope(kBent)};
    for (const Joint& joint : joints) {
        const contact::JointLaw law = jointLaws({joint}).front();
        std::vector<double> stresses = manyStresses(20000);
        std::sort(stresses.begin(), stresses.end());
        double last = contact::strengthOnCurve(law.curve, 0.0);
        for (const double stress : stresses) {
            const double now = contact::strengthOnCurve(law.curve, stress);
            CHECK(now >= last * (1 - 1e-12));
            last = now;
        }
        constexpr double kArea = 0.25, kStep = 1e-5;
        for (const double stress : {1.37e3, 4.21e4, 3.3e5, 7.77e6}) {
            const auto at = [&](double share) {
                return contact::shearStrength(law, kArea, share * stress * kArea, 1.0);
            };
            const double slope = (at(1 + kStep) - at(1 - kStep)) / (2 * kStep * stress * kArea);
            CHECK(contact::strengthSlope(law, kArea, stress * kArea, 1.0) ==
                  doctest::Approx(slope).epsilon(1e-6));
        }
    }
}

TEST_CASE("a contact point slips at the area times the strength at its stress, and does not lose any of it") {
    constexpr double kArea = 0.02, kOverlap = 3e-5;  // 3e5 Pa
    for (const Joint& joint : {bartonBandis(8, 5e7, 28), power(1.2, 0.8), envelope(kBent)}) {
        const PointForce force = pushed(joint, kArea, kOverlap);
        CHECK(force.slips);
        CHECK(-force.shear_1 == doctest::Approx(kArea * shearStrength(joint, 3e5)).epsilon(1e-6));
        const contact::JointLaw law = jointLaws({joint}).front();
        CHECK_FALSE(contact::hasMemory(law));
        PointMemory memory;
        for (int k = 1; k < 4; ++k)
            CHECK(contact::contactLaw(law, kArea, -kOverlap, 0.1 * k, 0.0, 1.0, memory).shear_1 ==
                  doctest::Approx(force.shear_1));
        CHECK(memory.bond == 1);
        CHECK(contact::contactLaw(law, kArea, kOverlap, 1.0, 0.0, 1.0, memory).open);
    }
}

TEST_CASE("a straight envelope is Coulomb's law to rounding, and memory makes no difference to any") {
    const double slope = std::tan(radians(31));
    const Joint straight = envelope({{0, 0}, {2e5, 2e5 * slope}, {1e6, 1e6 * slope}});
    for (const double overlap : {1e-9, 3e-6, 1.9e-5, 2.1e-5, 8e-5, 1e-2}) {
        const PointForce force = pushed(straight, 0.02, overlap),
                         coulomb = pushed(test::joint(31), 0.02, overlap);
        CHECK(force.shear_1 == doctest::Approx(coulomb.shear_1).epsilon(1e-14));
        CHECK(force.normal == coulomb.normal);
    }
    for (const Joint& joint : {straight, bartonBandis(8, 5e7, 28), test::joint(31)}) {
        const contact::JointLaw law = jointLaws({joint}).front();
        PointMemory one, other;
        for (int k = 0; k < 50; ++k) {
            const double gap = 1e-6 * (k % 7 - 5), slide = 1e-7 * ((k * 37) % 91);
            const auto a = contact::contactLaw<true>(law, 0.02, gap, slide, -slide, 1.0, one);
            const auto b = contact::contactLaw<false>(law, 0.02, gap, slide, -slide, 1.0, other);
            CHECK(a.shear_1 == b.shear_1);
            CHECK(a.normal == b.normal);
            CHECK(one.offset_1 == other.offset_1);
        }
    }
}

TEST_CASE("strength reduction divides the strength of every law, and strength_factor multiplies it") {
    for (Joint joint : {bartonBandis(8, 5e7, 28), power(1.2, 0.8), envelope(kBent)}) {
        const auto strength = [](const contact::JointLaw& law) {
            return contact::shearStrength(law, 0.5, 4e4, 1.0);
        };
        const double whole = strength(jointLaws({joint}).front());
        CHECK(strength(jointLaws({joint}, 1.7).front()) == doctest::Approx(whole / 1.7).epsilon(1e-12));
        CHECK(strength(jointLaws({reduced(joint, 1.7)}).front()) ==
              strength(jointLaws({joint}, 1.7).front()));
        joint.strength_factor = 0.4;
        CHECK(strength(jointLaws({joint}).front()) == doctest::Approx(0.4 * whole).epsilon(1e-12));
        CHECK(frictionAngle(joint) == doctest::Approx(std::atan2(shearStrength(joint, 1e5), 1e5)));
        CHECK((holding(joint, 1e15).law == StrengthLaw::coulomb));
    }
}

}  // namespace
}  // namespace talus
