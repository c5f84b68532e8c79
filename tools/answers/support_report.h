#pragma once
// Supports in results, each kind under its own name: bolts.

#include <string>
#include <vector>

#include "cli/json_fwd.h"
#include "talus/supports.h"

namespace talus::tools {

/// Adds a list for each kind under the name of that kind, also when it is empty.
void addSupports(const std::vector<Supports>& supports, Json& json);

/// The kind, and one line for each support: "A1: 200 kN, 50 % of what it can carry, yielded".
struct SupportTexts {
    std::string kind;
    std::vector<std::string> lines;
};
std::vector<SupportTexts> supportTexts(const std::vector<Supports>& supports);

}  // namespace talus::tools
