#pragma once
// The result as a report for the page.

#include "reproduction/results.h"

namespace talus::tools {

/// What the page shows, as report/README.md documents it.
Json paperReport(const PaperResults& results);

// --- its parts with tables, in a file of their own
// ------------------------------------------------------------------

Json table1(const PaperResults& results);
Json section5Table(const PaperResults& results);
Json dryPointsTable(const PaperResults& results);
Json quarterWaterTable(const PaperResults& results);
Json costsTable(const PaperResults& results);

/// Slope, water, joints, search: what was computed, as terms and what they are.
std::vector<std::pair<std::string, std::string>> parameters(const PaperResults& results);

}  // namespace talus::tools
