#pragma once
// Where a run's history goes: a CSV table, or snapshots in an MCAP file.

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "cli/common.h"
#include "cli/json_fwd.h"
#include "cli/scenario.h"
#include "cli/signals.h"
#include "talus/formats/history.h"
#include "talus/formats/scenario.h"
#include "talus/formats/snapshot.h"
#include "talus/simulation.h"

namespace talus::tools {

struct RunOptions {
    Common common;
    ScenarioInput scenario;
    std::string output, resume;
    bool force = false;
    int frames_per_full = 10;
    const char* output_option = "--output";       ///< what it is called in messages
    std::function<void()> give_up = requestStop;  ///< called once its file can no longer be written
};

/// Of a file that an analysis keeps beside its answer. Throws BadInput for a name that is not a snapshot's.
RunOptions optionsToKeep(const Common& common, const std::string& scenario, const std::string& file,
                         bool force, int frames_per_full, const char* option);

/// An earlier run to resume: its scenario, and the last of its full states that can be read.
struct Resumed {
    formats::Scenario scenario;
    FullFrame from;
    std::size_t full = 0;  ///< index of that state in its file
    int frames_per_full = 0;
    std::optional<formats::OutputFile> file;  ///< locked for writing, when the run is resumed in place
};

/// Reads the file of --resume. Throws BadInput.
Resumed readResumed(const RunOptions& options);

/// Writes the output of a run. Throws BadInput for a file that must not be replaced and FileRefused when the
/// file system refuses; a refusal during the run ends it, and finish() throws.
class RunRecorder {
 public:
    /// `resumed` gives up its file.
    RunRecorder(const RunOptions& options, const formats::Scenario& scenario, Resumed* resumed);

    /// For run(); the recorder must outlive it. `failure` goes into the header of a run that a search keeps.
    RunOutput output(std::optional<formats::SnapshotFailure> failure = std::nullopt);
    void finish(const Result<RunResult>& result);

    std::uint64_t bytes() const;  ///< of snapshots, once finished
    Json facts() const;           ///< of the snapshots, null without any
    std::string lines() const;    ///< the same as text

 private:
    void openHistory();
    void openSnapshots(const Resumed* resumed);
    void recordRow(const HistoryRecord& row);

    const RunOptions& options_;
    const formats::Scenario& scenario_;
    std::optional<formats::HistoryWriter> history_;
    std::optional<formats::SnapshotWriter> snapshots_;
    std::vector<Error> refused_;
    std::size_t frames_ = 0, fulls_ = 0;
    int frames_per_full_ = 1;
    bool resumed_ = false;
};

}  // namespace talus::tools
