#pragma once
// From joints as people describe them to the law's parameters. Apart from law.h, which is compiled for
// several instruction sets and must not bring strings along.

#include <vector>

#include "law/law.h"
#include "talus/joint.h"

namespace talus {

/// What frames do not keep: its restitution and residual factor, and the curve of its strength for the
/// strength_factor that the law has.
void setRest(const Joint& joint, contact::JointLaw& law);

/// The joints' laws with their strengths over `factor`.
std::vector<contact::JointLaw> jointLaws(const std::vector<Joint>& joints, double factor = 1.0);

}  // namespace talus
