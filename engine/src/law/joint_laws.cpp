#include "law/joint_laws.h"

#include <cmath>

namespace talus {

std::vector<contact::JointLaw> jointLaws(const std::vector<Joint>& joints, double factor) {
    std::vector<contact::JointLaw> laws;
    for (const Joint& joint : joints)
        laws.push_back({.normal_stiffness = joint.normal_stiffness,
                        .shear_stiffness = joint.shear_stiffness,
                        .tan_friction = std::tan(joint.friction) / factor,
                        .cohesion = joint.cohesion / factor,
                        .tensile_strength = joint.tensile_strength,
                        .residual_tan_friction = std::tan(joint.residual_friction) / factor,
                        .residual_cohesion = joint.residual_cohesion / factor,
                        .tan_dilation = std::tan(joint.dilation),
                        .bonded = joint.cohesion > 0 || joint.tensile_strength > 0});
    return laws;
}

}  // namespace talus
