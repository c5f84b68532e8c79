#pragma once
// The result as JSON and CSV.

#include <string>

#include "reproduction/results.h"

namespace talus::tools {

/// The object `talus paper --json` prints.
Json paperJson(const PaperResults& results);

/// All cases, one line each; units in the head, provenance in comment lines above it.
std::string paperCsv(const PaperResults& results);

/// The laboratory's tests of the paper's Table 1 in the same form.
std::string laboratoryCsv(const PaperResults& results);

}  // namespace talus::tools
