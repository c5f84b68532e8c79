#pragma once
// The law of each joint of a model, and strength reduction.

#include <vector>

#include "law/law.h"
#include "talus/model.h"

namespace talus {

/// Joint strengths as the kernel wants them; tan(phi) and C, peak and residual, divided by `factor`.
std::vector<contact::JointLaw> jointLaws(const std::vector<Joint>& joints, double factor = 1.0);

}  // namespace talus
