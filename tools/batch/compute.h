#pragma once
// One run: its scenario, its analysis, its row.

#include <atomic>
#include <optional>

#include "batch/rows.h"

namespace talus::tools::batch {

struct ComputedRow {
    Row cells;
    bool failed = false;
};

/// Computes a run in the calling thread. Any error gives a row with its reason; nothing only when `stop` was
/// set before a result.
std::optional<ComputedRow> computeRun(const formats::Sweep& sweep, const BatchInfo& info, std::uint64_t run,
                                      const std::atomic<bool>& stop);

/// CPU time of the calling thread [s].
double threadCpuSeconds();

}  // namespace talus::tools::batch
