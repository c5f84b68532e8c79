#pragma once
// The work of one process of a batch, and its progress.

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "batch/compute.h"
#include "batch/store.h"

namespace talus::tools::batch {

/// Progress of this process.
struct BatchProgress {
    std::uint64_t done = 0, failed = 0;  ///< rows this process has written
    std::uint64_t todo = 0;              ///< runs that had no row when it began
    double seconds = 0;                  ///< since it began
};

struct BatchWork {
    const formats::Sweep& sweep;
    Store& store;
    Shard shard;
    int threads = 1;
    bool retry = false;              ///< compute failed runs again
    std::vector<double> case_costs;  ///< relative, per case; empty when not known
    const std::atomic<bool>& stop;
    std::function<void()> abandon;                       ///< called once the results file cannot be written
    std::function<void(const BatchProgress&)> progress;  ///< never called twice at once
};

}  // namespace talus::tools::batch
