#pragma once
// Bolts in results.

#include <string>
#include <vector>

#include "cli/json_fwd.h"
#include "talus/bolts.h"

namespace talus::tools {

Json boltsJson(const std::vector<BoltReport>& bolts);

/// One line for each: "A1: 2.000e+05 N, 50 % of what it can carry, yielded".
std::vector<std::string> boltLines(const std::vector<BoltReport>& bolts);

}  // namespace talus::tools
