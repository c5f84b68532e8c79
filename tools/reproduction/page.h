#pragma once
// The result as a report for the page.

#include "reproduction/results.h"

namespace talus::tools {

/// Content of the page, as report/README.md documents it.
Json paperReport(const PaperResults& results);

// --- its parts with tables, in a file of their own
// ------------------------------------------------------------------

Json table1(const PaperResults& results);
Json section5Table(const PaperResults& results);
Json dryPointsTable(const PaperResults& results);
Json quarterWaterTable(const PaperResults& results);
Json costsTable(const PaperResults& results);

/// Slope, water, joints and search, as terms and their values.
std::vector<std::pair<std::string, std::string>> parameters(const PaperResults& results);

}  // namespace talus::tools
