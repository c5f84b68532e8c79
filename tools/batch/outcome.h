#pragma once
// A batch from its sweep to its report, and what came of it as JSON.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "batch/failure_map.h"
#include "batch/schedule.h"
#include "batch/warnings.h"
#include "cli/common.h"
#include "cli/json_fwd.h"
#include "talus/analysis.h"

namespace talus::tools::batch {

struct BatchRequest {
    Common common;
    std::string sweep, folder;
    Shard shard{};
    bool retry = false;                ///< compute failed runs again
    std::vector<std::string> maps{};   ///< files for the map of failure
    std::string map_3d{};              ///< page with the map on the slope; empty: none
    std::optional<double> map_cell{};  ///< [m]
    std::function<void()> abandon{};   ///< called once the results cannot be written
    std::function<void(const Progress&)> progress{};
    std::function<BatchProgress(const BatchWork&)> work = batch::work;  ///< who computes

    bool wantsMap() const { return !maps.empty() || !map_3d.empty(); }
    std::vector<std::string> mapFiles() const;  ///< of all kinds
};

struct BatchOutcome {
    std::uint64_t runs = 0, done = 0, failed = 0, computed = 0;
    std::uint64_t beyond = 0;  ///< rows of a larger batch in the same file, which do not count
    double wall_seconds = 0;
    bool interrupted = false;
    std::string identity, results;
    std::uint64_t seed = 0;
    std::vector<WarningGroup> warnings{};  ///< of all rows of the batch, or of the shard
    std::optional<FailureMap> map{};
};

/// Computes what is left to do, and writes the report of a whole batch. Throws BadInput, FileRefused.
BatchOutcome computeBatch(const formats::Sweep& sweep, const BatchRequest& request,
                          const std::atomic<bool>& stop);

Json batchJson(const BatchOutcome& outcome, const BatchRequest& request);

}  // namespace talus::tools::batch
