#pragma once
// The result for a terminal.

#include <string>

#include "reproduction/results.h"

namespace talus::tools {

/// Table 1 beside laboratory and theory, section 5, the contact points, and where the time went.
std::string terminalTable(const PaperResults& results);

/// A table of text cells: the first row is its head, columns are as wide as they need; numbers stand right.
std::string alignedTable(const std::vector<std::vector<std::string>>& rows, const std::string& indent);

}  // namespace talus::tools
