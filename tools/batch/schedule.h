#pragma once
// Runs side by side, each in one thread, all cores full.

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "batch/compute.h"
#include "batch/store.h"

namespace talus::tools::batch {

/// How far this process has come.
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

/// Computes what is left to do. Costly cases first, when costs are known; runs another process is at are left to it, and
/// looked at again at the end in case it died. Throws FileRefused once a row cannot be written: what is in the file
/// stays, what was being computed is dropped.
BatchProgress work(const BatchWork& batch);

/// Relative costs of the cases by the size of their models, when the sweep changes sizes and has few enough cases to
/// look; else empty. The cost of a search grows with the blocks, and a little more than in proportion.
std::vector<double> caseCosts(const formats::Sweep& sweep);

}  // namespace talus::tools::batch
