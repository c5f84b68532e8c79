#pragma once
// What an answer for time 0 leaves out.

#include <string>
#include <vector>

#include "talus/model.h"

namespace talus {

/// A warning for each water and each joint whose level or strength changes with time: all analyses but
/// histories and storms take it at time 0.
std::vector<std::string> heldAtTimeZero(const Model& model);

}  // namespace talus
