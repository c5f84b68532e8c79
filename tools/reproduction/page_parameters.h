#pragma once
// The page's section on what was computed, and how, read from the cases themselves.

#include <string>

#include "reproduction/results.h"

namespace talus::tools {

std::string htmlParameters(const PaperResults& results);

}  // namespace talus::tools
