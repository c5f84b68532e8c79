// Strengths of joints over time: the factor, the joint at a time, and its law.

#include <doctest/doctest.h>

#include "law/joint_laws.h"
#include "support/models.h"
#include "talus/joint.h"

using namespace talus;
using namespace talus::test;

namespace {

Joint thawing() {
    Joint ice = joint(40);
    ice.residual_friction = radians(25);
    ice.cohesion = 3e5;
    ice.residual_cohesion = 1e4;
    ice.tensile_strength = 2e4;
    ice.dilation = radians(3);
    ice.softening_displacement = 1e-3;
    ice.strength_over_time = {{10, 1.5}, {20, 0.5}, {40, 0.25}};
    return ice;
}

double shearStrengthOf(const contact::JointLaw& law, double stress) {
    return contact::strengthOnCurve(law.curve, stress);
}

}  // namespace

TEST_SUITE("engine") {
    TEST_CASE("strength over time: linear between the entries, constant beyond, 1 without a table") {
        const Joint ice = thawing();
        for (const auto& [time, factor] :
             {std::pair{0.0, 1.5}, {10, 1.5}, {15, 1.0}, {20, 0.5}, {30, 0.375}, {40, 0.25}, {1e9, 0.25}})
            CHECK(strengthFactor(ice, time) == doctest::Approx(factor).epsilon(1e-15));
        CHECK(changesStrength(ice));
        Joint plain = joint(40);
        CHECK(strengthFactor(plain, 12) == 1);
        CHECK_FALSE(changesStrength(plain));
        plain.strength_over_time = {{0, 0.7}, {5, 0.7}};
        CHECK_FALSE(changesStrength(plain));
    }

    TEST_CASE("strength over time multiplies tan(phi), C and tensile strength, and nothing else") {
        const Joint ice = thawing();
        const contact::JointLaw given = jointLaws({joint(40)}).front(),
                                whole = jointLaws({strengthAt(ice, 15)}).front(),
                                half = jointLaws({ice}, 1, 20).front();
        CHECK(whole.tan_friction == given.tan_friction);
        CHECK(half.tan_friction == 0.5 * whole.tan_friction);
        CHECK(half.residual_tan_friction == 0.5 * whole.residual_tan_friction);
        CHECK(half.cohesion == 0.5 * whole.cohesion);
        CHECK(half.residual_cohesion == 0.5 * whole.residual_cohesion);
        CHECK(half.tensile_strength == 0.5 * whole.tensile_strength);
        CHECK(half.normal_stiffness == whole.normal_stiffness);
        CHECK(half.shear_stiffness == whole.shear_stiffness);
        CHECK(half.tan_dilation == whole.tan_dilation);
        CHECK(half.softening == whole.softening);
        CHECK(half.bonded == whole.bonded);
    }

    TEST_CASE("strength over time: reduction divides on top; the joint at a time has the same law") {
        const Joint ice = thawing();
        const contact::JointLaw law = jointLaws({ice}, 1.3, 30).front(),
                                same = jointLaws({strengthAt(ice, 30)}, 1.3).front(),
                                other = jointLaws({reduced(ice, 1.3)}, 1, 30).front();
        for (const auto& parameter : contact::kLawParameters<double>) {
            CAPTURE(parameter.name);
            CHECK(same.*parameter.value == doctest::Approx(law.*parameter.value).epsilon(1e-15));
            CHECK(other.*parameter.value == doctest::Approx(law.*parameter.value).epsilon(1e-15));
        }
        CHECK(law.tan_friction == doctest::Approx(0.375 * std::tan(radians(40)) / 1.3).epsilon(1e-15));
        CHECK(law.tensile_strength == doctest::Approx(0.375 * 2e4).epsilon(1e-15));
        CHECK(strengthAt(ice, 30).strength_over_time.empty());
    }

    TEST_CASE("strength over time: curves, and laws that follow it through a history") {
        Joint rock = joint(30);
        rock.law = StrengthLaw::power;
        rock.a = 1.2;
        rock.b = 0.9;
        rock.strength_over_time = {{0, 1}, {10, 0.4}};
        std::vector<Joint> joints{joint(30), rock, thawing()};
        std::vector<contact::JointLaw> laws = jointLaws(joints);
        const auto before = laws;
        for (const double time : {2.0, 5.0, 5.0, 15.0, 30.0}) {
            CAPTURE(time);
            followStrengths(joints, time, laws);
            const auto made = jointLaws(joints, 1, time);
            for (std::size_t j = 0; j < joints.size(); ++j)
                for (const auto& parameter : contact::kLawParameters<double>)
                    CHECK(laws[j].*parameter.value ==
                          doctest::Approx(made[j].*parameter.value).epsilon(1e-12));
            CHECK(shearStrengthOf(laws[1], 3e4) ==
                  doctest::Approx(shearStrengthOf(made[1], 3e4)).epsilon(1e-12));
            CHECK(shearStrengthOf(laws[1], 3e4) ==
                  doctest::Approx(strengthFactor(rock, time) * shearStrengthOf(before[1], 3e4)));
        }
        const double* curve = laws[1].curve.at;
        followStrengths(joints, 40, laws);
        CHECK(laws[1].curve.at == curve);  // the factor is constant beyond the table

        followStrengths(joints, 1.2345, laws);  // 0.92593 of the strength
        curve = laws[1].curve.at;
        CHECK(laws[1].strength_factor == doctest::Approx(0.926).epsilon(1e-15));
        followStrengths(joints, 1.2346, laws);
        CHECK(laws[1].curve.at == curve);  // no new curve for less than a step of the factor
    }

    TEST_CASE("strength over time leaves what contact points remember as it is") {
        for (const double factor : {kStrengthOverTime.min, 0.3, 9.9}) {
            for (Joint each : {thawing(), joint(30)}) {
                const bool remembers = contact::hasMemory(jointLaws({each}).front());
                each.strength_over_time = {{0, factor}};
                CHECK(contact::hasMemory(jointLaws({each}).front()) == remembers);
            }
        }
    }
}
