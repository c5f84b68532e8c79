#pragma once
// Keeping the run in which a search saw the slope fail: played on with true inertia until it is plain to see,
// as a snapshot file like those of talus run.

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
    std::optional<double> seconds;  ///< to play on; by default until some block has gone its own size
    bool force = false;
};

/// Adds --keep-run, --keep-run-time and --force to a subcommand.
void addKeepRun(CLI::App& app, KeepRunOptions& options);

/// What was kept, or why nothing was.
struct KeptRun {
    std::string file;    ///< empty when nothing was kept
    std::string reason;  ///< why nothing was kept, or what went wrong on the way
    int exit_code = kDone;
    const LoadSearch* search = nullptr;               ///< that saw it fail
    formats::SnapshotFailure failure;                 ///< load, mode, and each block's role
    std::vector<std::string> slides, topples, stays;  ///< names of the free blocks by role
    RunResult run;
    std::size_t frames = 0, fulls = 0;
    std::uint64_t bytes = 0;
    std::string farthest;        ///< the block that went farthest
    double farthest_way = 0;     ///< [m]
    formats::Scenario scenario;  ///< as it fails
    RunGeometry geometry;
    LightFrame last;  ///< where the run ends
};

Json keptRunJson(const KeptRun& kept);  ///< {file, reason, load, simulated_seconds, frames, ..., slides, ...}

/// The same for people: labels and contents of the lines of a table.
std::vector<std::pair<std::string, std::string>> keptRunLines(const KeptRun& kept);

/// Keeps one run. What can be refused is refused at once, before anybody has searched for minutes: throws
/// BadInput when the file must not be replaced, and FileRefused when it cannot be written.
class FailureKeeper {
 public:
    /// Everything handed in must outlive the keeper.
    FailureKeeper(const KeepRunOptions& options, const Common& common, const formats::Scenario& scenario);

    FailureKeeper(const FailureKeeper&) = delete;
    FailureKeeper& operator=(const FailureKeeper&) = delete;

    bool wanted() const { return recorder_ != nullptr; }

    /// Plays the failure on. What goes wrong is told in the result, so that what was found is not lost with
    /// it.
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
