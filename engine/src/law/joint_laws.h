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

/// The joints' laws at a time [s], with their strengths over `factor`. Searches use those of time 0. What
/// contact points remember is the same at all times, because no strength falls to zero (kStrengthOverTime).
std::vector<contact::JointLaw> jointLaws(const std::vector<Joint>& joints, double factor = 1.0,
                                         double time = 0.0);

/// Brings the laws of joints whose strength changes to a time of a history [s]; curves in small steps.
void followStrengths(const std::vector<Joint>& joints, double time, std::vector<contact::JointLaw>& laws);

}  // namespace talus
