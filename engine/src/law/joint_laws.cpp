#include "law/joint_laws.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace talus {
namespace {

/// Which parameter of the law a property becomes, by the name it gives.
constexpr double contact::JointLaw::*parameterOf(const JointProperty& property) {
    for (const auto& parameter : contact::kLawParameters<double>)
        if (property.in_law == parameter.name) return parameter.value;
    return nullptr;
}

constexpr bool allAreKnown() {
    for (const JointProperty& property : kJointProperties)
        if (!property.in_law.empty() && parameterOf(property) == nullptr) return false;
    return true;
}
static_assert(allAreKnown(), "a property names a parameter that the law does not have");

// Steps of a factor of 1, by which the strength of a curve changes in a history. Its table takes 0.4 ms to
// make: a new one every ten steps would take most of the time of a small model. Strengths are at most 1e-4
// off.
constexpr double kCurveSteps = 5000;

/// At a time of a history.
double steppedFactor(const Joint& joint, double time) {
    const double factor = strengthFactor(joint, time);
    return joint.law == StrengthLaw::coulomb ? factor : std::round(factor * kCurveSteps) / kCurveSteps;
}

/// \param strength  factor of its strengths
contact::JointLaw withoutRest(const Joint& joint, double factor, double strength) {
    contact::JointLaw law;
    for (const JointProperty& property : kJointProperties)
        if (!property.in_law.empty())
            law.*parameterOf(property) = lawValue(joint, property, factor, strength);
    law.bonded = joint.cohesion > 0 || joint.tensile_strength > 0;
    return law;
}

bool agree(const contact::JointLaw& a, const contact::JointLaw& b) {
    return std::all_of(contact::kLawParameters<double>.begin(), contact::kLawParameters<double>.end(),
                       [&](const auto& parameter) { return a.*parameter.value == b.*parameter.value; });
}

}  // namespace

void setRest(const Joint& joint, contact::JointLaw& law) {
    law.residual_factor = joint.residual_factor;
    law.unloading_loss = 1 - joint.restitution_normal * joint.restitution_normal;
    law.setCurve(contact::strengthCurve(joint, law.strength_factor));
}

std::vector<contact::JointLaw> jointLaws(const std::vector<Joint>& joints, double factor, double time) {
    std::vector<contact::JointLaw> laws;
    laws.reserve(joints.size());
    for (const Joint& joint : joints) {
        laws.push_back(withoutRest(joint, factor, strengthFactor(joint, time)));
        setRest(joint, laws.back());
    }
    return laws;
}

void followStrengths(const std::vector<Joint>& joints, double time, std::vector<contact::JointLaw>& laws) {
    for (std::size_t j = 0; j < joints.size(); ++j) {
        if (!changesStrength(joints[j])) continue;
        contact::JointLaw law = withoutRest(joints[j], 1, steppedFactor(joints[j], time));
        if (agree(law, laws[j])) continue;  // the same curve, which takes time to make
        setRest(joints[j], law);
        laws[j] = std::move(law);
    }
}

}  // namespace talus
