#pragma once
// From joints as people describe them to the law's parameters. Apart from law.h, which is compiled for several instruction
// sets and must not bring strings along.

#include <array>
#include <vector>

#include "law/law.h"
#include "talus/joint.h"

namespace talus {

/// Which parameter of the law each property becomes, in the order of kJointProperties.
inline constexpr std::array<double contact::JointLaw::*, kJointPropertyCount> kLawParameters{
    &contact::JointLaw::normal_stiffness,      &contact::JointLaw::shear_stiffness,
    &contact::JointLaw::tan_friction,          &contact::JointLaw::cohesion,
    &contact::JointLaw::tensile_strength,      &contact::JointLaw::residual_cohesion,
    &contact::JointLaw::residual_tan_friction, &contact::JointLaw::tan_dilation};

static_assert(kLawParameters.back() != nullptr, "a property without a parameter of the law");

/// The joints' laws with their strengths over `factor`.
std::vector<contact::JointLaw> jointLaws(const std::vector<Joint>& joints, double factor = 1.0);

}  // namespace talus
