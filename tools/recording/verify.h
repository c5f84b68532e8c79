#pragma once
// Computes a run again between the full states of its file, and compares state hashes.

#include <string>
#include <vector>

#include "cli/common.h"
#include "recording/snapshot_view.h"

namespace talus::tools {

/// The result of a stretch of the run: from one full state (or from the scenario) to the next.
struct Stretch {
    double from = 0, to = 0;  ///< [s]
    std::size_t frames = 0;   ///< compared
    std::string fault;        ///< the first difference; empty when all hashes are equal
};

struct Verification {
    std::vector<Stretch> stretches;
    std::size_t frames = 0;
    bool interrupted = false;
    bool equal() const;
};

/// Every stretch by itself, on the threads of the options; `show` gets the share done. Throws BadInput when
/// the file's scenario cannot be built.
Verification verifyRun(formats::SnapshotReader& reader, const Common& common,
                       const std::function<void(const Progress&)>& show);

/// Whether the file was written by this very build, which alone promises the same bits.
bool sameBuild(const formats::SnapshotHeader& header);

}  // namespace talus::tools
