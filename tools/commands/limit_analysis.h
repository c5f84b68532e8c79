#pragma once
// talus limit-analysis, and the ceiling it gives for the answers of a search.

#include "cli/command.h"

namespace talus::tools {

Command addLimitAnalysis(CLI::App& root);

}  // namespace talus::tools
