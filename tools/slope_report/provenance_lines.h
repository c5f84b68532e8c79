#pragma once
// Provenance of a report: the same on the page and above its tables. No times and no thread count, so that
// the same input gives the same bytes.

#include <string>
#include <utility>
#include <vector>

#include "slope_report/slope_report.h"

namespace talus::tools {

std::string fileName(const SlopeReport& report);  ///< of the scenario, without its folder

/// {version, git hash, ..., XXH128 of each input}
std::vector<std::pair<std::string, std::string>> provenanceItems(const SlopeReport& report);

/// The same as comment lines of CSV.
std::string provenanceLines(const SlopeReport& report);

}  // namespace talus::tools
