#include "law/joint_laws.h"

#include <string_view>

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

contact::JointLaw lawOf(const Joint& joint, double factor) {
    contact::JointLaw law;
    for (const JointProperty& property : kJointProperties)
        if (!property.in_law.empty()) law.*parameterOf(property) = lawValue(joint, property, factor);
    law.bonded = joint.cohesion > 0 || joint.tensile_strength > 0;
    setRest(joint, law);
    return law;
}

}  // namespace

void setRest(const Joint& joint, contact::JointLaw& law) {
    law.residual_factor = joint.residual_factor;
    law.unloading_loss = 1 - joint.restitution_normal * joint.restitution_normal;
    law.setCurve(contact::strengthCurve(joint, law.strength_factor));
}

std::vector<contact::JointLaw> jointLaws(const std::vector<Joint>& joints, double factor) {
    std::vector<contact::JointLaw> laws;
    laws.reserve(joints.size());
    for (const Joint& joint : joints) laws.push_back(lawOf(joint, factor));
    return laws;
}

}  // namespace talus
