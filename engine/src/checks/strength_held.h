#pragma once
// A warning for analyses that hold strengths which change over time.

#include <string>
#include <vector>

#include "talus/model.h"

namespace talus::checks {

/// One line per joint whose strength changes over time, for an analysis that takes that of time 0. Joints
/// derived from one of the file's ("default@18.5deg") have the line of that one.
std::vector<std::string> strengthsHeld(const Model& model);

}  // namespace talus::checks
