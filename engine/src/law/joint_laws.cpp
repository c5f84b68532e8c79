#include "law/joint_laws.h"

namespace talus {
namespace {

contact::JointLaw lawOf(const Joint& joint, double factor) {
    contact::JointLaw law;
    for (std::size_t p = 0; p < kJointPropertyCount; ++p)
        law.*kLawParameters[p] = lawValue(joint, kJointProperties[p], factor);
    law.bonded = joint.cohesion > 0 || joint.tensile_strength > 0;
    return law;
}

}  // namespace

std::vector<contact::JointLaw> jointLaws(const std::vector<Joint>& joints, double factor) {
    std::vector<contact::JointLaw> laws;
    laws.reserve(joints.size());
    for (const Joint& joint : joints) laws.push_back(lawOf(joint, factor));
    return laws;
}

}  // namespace talus
