#pragma once
// From a model's joints to the law's parameters. Apart from law.h, which is compiled for several instruction
// sets and must not include strings.

#include <vector>

#include "law/law.h"
#include "talus/joint.h"

namespace talus {

/// Sets the parameters that frames do not hold: restitution, residual factor, and the strength curve for the
/// law's strength_factor.
void setRest(const Joint& joint, contact::JointLaw& law);

/// The joints' laws with their strengths over `factor`.
std::vector<contact::JointLaw> jointLaws(const std::vector<Joint>& joints, double factor = 1.0);

}  // namespace talus
