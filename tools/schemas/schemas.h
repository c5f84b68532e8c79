#pragma once
// The JSON Schemas as they were when the program was built (maker.cpp).

#include <string_view>

namespace talus::tools {

extern const std::string_view kScenarioSchema;
extern const std::string_view kSweepSchema;

}  // namespace talus::tools
