#pragma once
// Computing all cases: many single-threaded runs side by side.

#include <atomic>
#include <functional>
#include <vector>

#include "reproduction/results.h"

namespace talus::tools {

/// The computation of one case: talus::criticalAngle, or a stand-in in tests.
using Search = std::function<Result<SearchResult>(const Model&, const Control&)>;

/// How far all cases together have come.
struct PaperProgress {
    std::size_t done = 0, total = 0;
    double fraction = 0;             ///< by expected cost, running cases included
    const PaperRun* last = nullptr;  ///< the last one that was completed, if any
};

/// Runs every case on `threads` threads, each case in one of them, costly ones first. The result is in the
/// order of the cases. After `stop` nothing new is begun and running cases end early. `progress` is never
/// called twice at once.
std::vector<PaperRun> runCases(std::vector<PaperCase> cases, const Search& search, int threads,
                               const std::atomic<bool>& stop,
                               const std::function<void(const PaperProgress&)>& progress);

/// "12 of 41 done".
std::string doneText(const PaperProgress& progress);

}  // namespace talus::tools
