#pragma once
// The cases of the reproduction of the paper.

#include <string>
#include <vector>

#include "reproduction/results.h"

namespace talus::tools {

/// All cases, in the order they are reported: Table 1 (by fissure, then friction), section 5, the study of
/// contact points, the paper's own points with water. `points` is the rule of Table 1 and section 5. Throws
/// BadInput when the rule is not one.
std::vector<PaperCase> paperCases(const std::string& points);

/// Relative computing time of a case, for starting the costly ones first.
double expectedCost(const PaperCase& what);

}  // namespace talus::tools
