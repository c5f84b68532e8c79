#pragma once
// summary.json, report.html and report.json of a batch.

#include <string>

#include "batch/summary.h"
#include "cli/common.h"
#include "cli/json_fwd.h"

namespace talus::tools::batch {

/// "3 rows of a batch with more samples stay in results.csv and do not count"
std::string rowsBeyond(std::uint64_t rows, const std::string& file);

/// What the page shows, as report/README.md documents it.
Json batchReport(const Summary& summary, const Json& provenance);

/// Writes the files, and returns what they tell. Throws FileRefused.
Summary writeReport(const std::string& folder, const StoredBatch& batch, const Common& common);

}  // namespace talus::tools::batch
