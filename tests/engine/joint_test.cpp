// The table of joint properties, and what follows from it.

#include "talus/joint.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <string>

#include "law/joint_laws.h"
#include "support/models.h"

namespace talus {
namespace {

using test::radians;

constexpr std::array kStrengthLaws{StrengthLaw::coulomb, StrengthLaw::barton_bandis, StrengthLaw::envelope,
                                   StrengthLaw::power};

/// Every property its own value.
Joint numbered() {
    Joint joint;
    for (std::size_t p = 0; p < kJointPropertyCount; ++p)
        joint.*kJointProperties[p].value = 0.1 * static_cast<double>(p + 1);
    return joint;
}

TEST_CASE("the table has every number of a joint once, under keys of their own") {
    struct Numbers {
        std::string name;
        StrengthLaw law;
        std::array<double, kJointPropertyCount> values;
        bool tension_reduced;
        std::vector<EnvelopePoint> shear_strength;
        std::vector<LevelPoint> strength_over_time;
    };
    static_assert(sizeof(Joint) == sizeof(Numbers), "a number of Joint is not in kJointProperties");
    const Joint joint = numbered();
    std::set<double> values;
    std::set<std::string_view> keys;
    for (std::size_t p = 0; p < kJointPropertyCount; ++p) {
        const JointProperty& property = kJointProperties[p];
        values.insert(joint.*property.value);
        keys.insert(property.key);
        CHECK(jointProperty(property.key) == p);
        CHECK(jointProperty(property.value) == p);
        for (const StrengthLaw law : kStrengthLaws) {
            CHECK((!property.required_by.has(law) || property.laws.has(law)));
            CHECK((!property.reduced_in.has(law) || property.laws.has(law)));
        }
        CHECK(property.key.ends_with("_deg") == property.isAngle());
        CHECK_FALSE(property.what.empty());
    }
    CHECK(values.size() == kJointPropertyCount);
    CHECK(keys.size() == kJointPropertyCount);
    CHECK_FALSE(jointProperty("fricton_deg").has_value());
}

TEST_CASE("each property is a parameter of the law of its own: angles by their tangent") {
    const contact::JointLaw law = jointLaws({numbered()}).front();
    CHECK(law.normal_stiffness == 0.1 * 1);
    CHECK(law.tan_friction == std::tan(0.1 * 3));
    CHECK(law.cohesion == 0.1 * 4);
    CHECK(law.tensile_strength == 0.1 * 5);
    CHECK(law.residual_cohesion == 0.1 * 6);
    CHECK(law.residual_tan_friction == std::tan(0.1 * 7));
    CHECK(law.tan_dilation == std::tan(0.1 * 8));
    CHECK(law.bonded);
}

TEST_CASE("the list of the law's parameters has every number of the law once") {
    struct Numbers {
        std::array<double, contact::kLawParameterCount> values;
        double residual_factor, unloading_loss;  // of the joint alone
        bool bonded, curved;
        const double* curve;
    };
    static_assert(sizeof(contact::JointParameters<double>) == sizeof(Numbers),
                  "a number of the law is not in its list");
    contact::JointLaw law;
    std::set<std::string_view> names;
    for (const auto& parameter : contact::kLawParameters<double>) {
        CHECK(law.*parameter.value == 0);
        law.*parameter.value = 1;
        CHECK(names.insert(parameter.name).second);
    }
}

TEST_CASE("strength reduction divides tan(phi) and C, peak and residual, and nothing else") {
    const Joint joint = numbered();
    const contact::JointLaw law = jointLaws({joint}, 1.7).front(), whole = jointLaws({joint}).front();
    CHECK(law.tan_friction == whole.tan_friction / 1.7);
    CHECK(law.residual_tan_friction == whole.residual_tan_friction / 1.7);
    CHECK(law.cohesion == whole.cohesion / 1.7);
    CHECK(law.residual_cohesion == whole.residual_cohesion / 1.7);
    CHECK(law.tensile_strength == whole.tensile_strength);
    CHECK(law.normal_stiffness == whole.normal_stiffness);
    CHECK(law.tan_dilation == whole.tan_dilation);
    const contact::JointLaw same = jointLaws({reduced(joint, 1.7)}).front();
    for (const auto& parameter : contact::kLawParameters<double>)
        CHECK(same.*parameter.value == doctest::Approx(law.*parameter.value).epsilon(1e-15));
}

}  // namespace
}  // namespace talus
