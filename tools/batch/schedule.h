#pragma once
// Runs side by side, each in one thread, all cores full.

#include <vector>

#include "batch/work.h"

namespace talus::tools::batch {

/// Computes what is left to do. Costly cases first, when costs are known. Runs claimed by another process are
/// left to it, and checked at the end in case it died. Throws FileRefused once a row cannot be written: rows
/// in the file stay, runs in progress are dropped.
BatchProgress work(const BatchWork& batch);

/// Relative costs of the cases by the size of their models, when the sweep changes sizes and has few enough
/// cases to look; else empty. The cost of a search grows with the blocks, and a little more than in
/// proportion.
std::vector<double> caseCosts(const formats::Sweep& sweep);

}  // namespace talus::tools::batch
