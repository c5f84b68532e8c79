#pragma once
// What users should know of an answer beside the figure.

#include <string>
#include <vector>

#include "analysis/probing.h"

namespace talus::analysis {

/// \param last  the state the search ended in: let go if it `fails`
std::vector<std::string> searchWarnings(const Probing& probing, const State& last, bool fails);

}  // namespace talus::analysis
