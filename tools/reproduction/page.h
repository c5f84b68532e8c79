#pragma once
// The result as one HTML page without any outside resource: readable without scripts, light or dark, on paper
// as well.

#include <string>

#include "reproduction/results.h"

namespace talus::tools {

std::string paperPage(const PaperResults& results);

}  // namespace talus::tools
