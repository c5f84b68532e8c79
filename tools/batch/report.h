#pragma once
// summary.json and report.html of a batch.

#include <string>

#include "batch/summary.h"
#include "cli/command.h"

namespace talus::tools::batch {

/// One HTML page without any outside resource: readable without scripts, light or dark, on paper as well.
std::string batchPage(const Summary& summary, const Json& provenance);

/// Writes both files. Throws FileRefused.
void writeReport(const std::string& folder, const StoredBatch& batch, const Common& common);

}  // namespace talus::tools::batch
