#pragma once
// Keeps the failing run of a search as a snapshot file like those of talus run, continued with true inertia
// until the failure is plain to see.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/common.h"
#include "cli/failures.h"
#include "cli/json_fwd.h"
#include "recording/run_output.h"
#include "talus/formats/scenario.h"
#include "talus/searches.h"

namespace CLI {
class App;
}

namespace talus::tools {

struct KeepRunOptions {
    std::string file;               ///< empty: nothing is kept
    std::optional<double> seconds;  ///< duration; by default until some block is displaced by its own size
    bool force = false;
};

/// Adds --keep-run, --keep-run-time and --force to a subcommand.
void addKeepRun(CLI::App& app, KeepRunOptions& options);

/// The kept run, or why there is none.
struct KeptRun {
    std::string file;    ///< empty when nothing was kept
    std::string reason;  ///< why nothing was kept, or an error during the run
    int exit_code = kDone;
    const LoadSearch* search = nullptr;               ///< that found the failure
    formats::SnapshotFailure failure;                 ///< load, mode, and each block's role
    std::vector<std::string> slides, topples, stays;  ///< names of the free blocks by role
    RunResult run;
    std::size_t frames = 0, fulls = 0;
    std::uint64_t bytes = 0;
    std::string farthest;        ///< the block of largest displacement
    double farthest_way = 0;     ///< [m]
    formats::Scenario scenario;  ///< as it fails
    RunGeometry geometry;
    LightFrame last;  ///< where the run ends
};

Json keptRunJson(const KeptRun& kept);  ///< {file, reason, load, simulated_seconds, frames, ..., slides, ...}

/// The same as text: labels and contents of the lines of a table.
std::vector<std::pair<std::string, std::string>> keptRunLines(const KeptRun& kept);

/// Keeps one run. Refuses at once, before minutes of search: throws BadInput when the file must not be
/// replaced, and FileRefused when it cannot be written.
class FailureKeeper {
 public:
    /// All arguments must outlive the keeper.
    FailureKeeper(const KeepRunOptions& options, const Common& common, const formats::Scenario& scenario);

    FailureKeeper(const FailureKeeper&) = delete;
    FailureKeeper& operator=(const FailureKeeper&) = delete;

    bool wanted() const { return recorder_ != nullptr; }

    /// Continues the failure as a run. Errors are part of the result, so that the answer is not lost.
    /// \pre wanted(), and the search was made with Control::keep_failing_state
    KeptRun keep(const SearchResult& result, const LoadSearch& search, const Control& control);

 private:
    void play(const FailingState& failing, KeptRun& kept, const Control& control);

    const KeepRunOptions& options_;
    const formats::Scenario& scenario_;
    RunOptions run_options_;
    formats::Scenario as_it_fails_;
    std::unique_ptr<RunRecorder> recorder_;
};

}  // namespace talus::tools
