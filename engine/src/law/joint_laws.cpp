#include "law/joint_laws.h"

#include <algorithm>
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

contact::JointLaw withoutRest(const Joint& joint, double factor, double time) {
    const double strength = strengthFactor(joint, time);
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
        laws.push_back(withoutRest(joint, factor, time));
        setRest(joint, laws.back());
    }
    return laws;
}

void followStrengths(const std::vector<Joint>& joints, double time, std::vector<contact::JointLaw>& laws) {
    for (std::size_t j = 0; j < joints.size(); ++j) {
        if (!changesStrength(joints[j])) continue;
        contact::JointLaw law = withoutRest(joints[j], 1, time);
        if (agree(law, laws[j])) continue;  // the same curve, which takes time to make
        setRest(joints[j], law);
        laws[j] = std::move(law);
    }
}

}  // namespace talus
