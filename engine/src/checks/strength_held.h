#pragma once
// Warnings where strengths are held that change.

#include <optional>
#include <string>
#include <vector>

#include "talus/model.h"

namespace talus::checks {

/// One line per joint whose strength changes over time, for an analysis that takes that of time 0. Joints
/// derived from one of the file's ("default@18.5deg") have the line of that one.
std::vector<std::string> strengthsHeld(const Model& model);

/// For a history of joints that water weakens: what is wet stays as it is at time 0, also where a level
/// changes.
std::optional<std::string> wetJointsHeld(const Model& model);

}  // namespace talus::checks
