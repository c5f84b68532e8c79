#include "recording/run_output.h"

#include <fcntl.h>
#include <sys/sendfile.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "cli/failures.h"
#include "cli/json.h"
#include "cli/outputs.h"
#include "cli/provenance.h"
#include "cli/text.h"
#include "talus/build_info.h"
#include "talus/flow.h"

namespace talus::tools {

namespace {

constexpr double kWorthSaying = 0.01;  // [s] waited for the disk

void throwIfRefused(const std::vector<Error>& errors) {
    if (!errors.empty())
        throw FileRefused((errors.front().file.empty() ? errors.front().field : errors.front().file) + ": " +
                          errors.front().message);
}

bool isHistory(const std::string& path) { return path.ends_with(".csv"); }

bool wasInterrupted(const std::string& snapshots) {
    const auto reader = formats::SnapshotReader::open(snapshots);
    return reader.ok() && reader->end() && reader->end()->ended == "interrupted";
}

/// A finished file, or one of another kind, is only replaced on request.
void refuseToOverwrite(const RunOptions& options) {
    if (options.force) return;
    bool finished = false, foreign = false;
    const char* kind = isHistory(options.output) ? "history" : "snapshot file";
    if (isHistory(options.output)) {
        const formats::HistoryFile found = formats::inspectHistory(options.output);
        finished = found == formats::HistoryFile::finished, foreign = found == formats::HistoryFile::foreign;
    } else {
        const formats::SnapshotFile found = formats::inspectSnapshot(options.output);
        finished = found == formats::SnapshotFile::finished,
        foreign = found == formats::SnapshotFile::foreign;
    }
    const std::string remedy = "; --force replaces it, or choose another file";
    if (finished && !isHistory(options.output) && wasInterrupted(options.output)) {
        throw BadInput(Error{options.output_option,
                             "holds a run that was interrupted; talus run --resume continues it" + remedy,
                             options.output});
    }
    if (finished)
        throw BadInput(
            Error{options.output_option, "holds a finished " + std::string(kind) + remedy, options.output});
    if (foreign)
        throw BadInput(Error{options.output_option, "exists and is not a " + std::string(kind) + remedy,
                             options.output});
}

void noteOtherBuild(const RunOptions& options, const BuildInfo& then) {
    const BuildInfo& now = buildInfo();
    if (then.git_hash == now.git_hash && then.compiler == now.compiler && then.build_type == now.build_type &&
        then.instruction_set == now.instruction_set)
        return;
    note(options.common, "warning: " + options.resume + " was started by another build (" + then.version +
                             ", " + then.git_hash + ", " + then.compiler + ", " + then.instruction_set +
                             "): the run continues, but not to the same bits");
}

/// Into a file that is locked already, so that no other process writes to it. 0, or an errno.
int copyInto(const formats::OutputFile& target, int source) {
    constexpr std::size_t kStretch = std::size_t{1} << 26;  // [bytes]
    if (::ftruncate(target.file(), 0) != 0) return errno;
    while (true) {
        const ssize_t count = ::sendfile(target.file(), source, nullptr, kStretch);
        if (count == 0) return 0;
        if (count < 0 && errno != EINTR) return errno;
    }
}

void copyFile(const std::string& from, const formats::OutputFile& to) {
    const int source = ::open(from.c_str(), O_RDONLY | O_CLOEXEC);
    if (source < 0) throw FileRefused(from, "cannot be opened", errno);
    const int error = copyInto(to, source);
    ::close(source);
    if (error != 0) throw FileRefused(to.path(), "cannot be written", error);
}

bool inPlace(const RunOptions& options) {
    std::error_code absent;
    return options.output.empty() || std::filesystem::equivalent(options.output, options.resume, absent);
}

formats::SnapshotWriter continued(formats::OutputFile file, std::size_t full) {
    auto writer = formats::SnapshotWriter::continueFile(std::move(file), full);
    throwIfRefused(writer.errors());
    return std::move(*writer);
}

/// Nothing where there is none: the run has reported that already. Nor of coupled flow: its pressure is that
/// of an equilibrium, and steadyFlow has the stated apertures.
std::optional<formats::SnapshotFlow> pressureOfFlow(const Model& model) {
    if (model.flow->coupled) return std::nullopt;
    const auto flow = steadyFlow(model);
    if (!flow) return std::nullopt;
    return formats::flowOf(*flow, model);
}

}  // namespace

RunOptions optionsToKeep(const Common& common, const std::string& scenario, const std::string& file,
                         bool force, int frames_per_full, const char* option) {
    requireEnding(option, file, {".mcap"});
    return {.common = common,
            .scenario = {scenario, {}},
            .output = file,
            .resume = "",
            .force = force,
            .frames_per_full = frames_per_full,
            .output_option = option};
}

Resumed readResumed(const RunOptions& options) {
    std::optional<Result<formats::OutputFile>> held;  // before it is read: no process may change it any more
    if (inPlace(options)) held.emplace(formats::OutputFile::openExisting(options.resume));
    auto reader = valueOf(formats::SnapshotReader::open(options.resume));
    if (held) throwIfRefused(held->errors());
    // A finished run without its index, killed in its last moment, is finished once more.
    const bool is_finished = reader.end() && reader.end()->ended == "finished" && reader.faults().empty();
    if (options.output.empty() && is_finished) {
        throw BadInput(
            Error{"--resume", "holds a finished run: there is nothing left to do", options.resume});
    }
    // A copy keeps the damage; in place nothing before the last full state is changed.
    for (const std::string& fault : held ? reader.faults() : reader.verify())
        note(options.common, "note: " + options.resume + ": " + fault);
    noteOtherBuild(options, reader.header().build);
    const formats::SnapshotHeader& header = reader.header();
    for (std::size_t k = reader.fulls(); k-- > 0;) {
        auto full = reader.full(k);
        if (!full) continue;
        Resumed resumed{valueOf(formats::parseScenario(header.scenario_text, header.scenario_path)),
                        std::move(*full), k, header.frames_per_full, std::nullopt};
        if (held) resumed.file.emplace(std::move(**held));
        return resumed;
    }
    throw BadInput(
        Error{"--resume", "holds no full state to continue from; run the scenario again", options.resume});
}

RunRecorder::RunRecorder(const RunOptions& options, const formats::Scenario& scenario, Resumed* resumed)
    : options_(options),
      scenario_(scenario),
      frames_per_full_(resumed != nullptr ? resumed->frames_per_full : options.frames_per_full),
      resumed_(resumed != nullptr) {
    if (options.output.empty() && !resumed_) {
        note(options.common, "note: without -o FILE nothing is written");
        return;
    }
    const bool in_place = resumed_ && inPlace(options);
    if (!in_place) {
        requireEnding(options.output_option, options.output, {".mcap", ".csv"});
        refuseInput(options.output_option, options.output);
    }
    if (isHistory(options.output)) {
        openHistory();
    } else if (in_place) {
        snapshots_.emplace(continued(std::move(*resumed->file), resumed->full));
    } else {
        openSnapshots(resumed);
    }
}

void RunRecorder::openHistory() {
    if (resumed_)
        throw BadInput(Error{"--output",
                             "is a CSV table, which would lack the time before the restart; allowed with "
                             "--resume: a .mcap file",
                             options_.output});
    formats::OutputFile file = takeOutput(options_.common, options_.output);
    refuseToOverwrite(options_);
    history_.emplace(std::move(file), provenanceComments(options_.common, scenario_.path),
                     scenario_.model.run.watch);
}

void RunRecorder::openSnapshots(const Resumed* resumed) {
    formats::OutputFile file = takeOutput(options_.common, options_.output);
    refuseToOverwrite(options_);
    if (resumed == nullptr) {
        snapshots_.emplace(formats::SnapshotWriter::begin(std::move(file)));
    } else {
        copyFile(options_.resume, file);
        snapshots_.emplace(continued(std::move(file), resumed->full));
    }
}

void RunRecorder::recordRow(const HistoryRecord& row) {
    if (!refused_.empty()) return;
    refused_ = history_->write(row);
    if (!refused_.empty()) options_.give_up();
}

RunOutput RunRecorder::output(std::optional<formats::SnapshotFailure> failure) {
    RunOutput output;
    if (history_) output.record = [this](const HistoryRecord& row) { recordRow(row); };
    if (!snapshots_) return output;
    output.frames_per_full = frames_per_full_;
    if (!resumed_)
        output.begin = [this, failure = std::move(failure)](const RunGeometry& geometry) {
            auto header = formats::headerOf(scenario_, geometry, commandLine(), frames_per_full_);
            header.failure = failure;
            if (scenario_.model.flow) header.flow = pressureOfFlow(scenario_.model);
            snapshots_->write(std::move(header));
        };
    const auto write = [this](auto&& frame, std::size_t& count) {
        snapshots_->write(std::move(frame));
        ++count;
        if (snapshots_->failed()) options_.give_up();
    };
    output.light = [this, write](LightFrame&& frame) { write(std::move(frame), frames_); };
    output.full = [this, write](FullFrame&& frame) { write(std::move(frame), fulls_); };
    return output;
}

void RunRecorder::finish(const Result<RunResult>& result) {
    throwIfRefused(refused_);
    const char* ended = !result ? "failed" : result->interrupted ? "interrupted" : "finished";
    if (history_) throwIfRefused(history_->finish(ended));
    if (!snapshots_) return;
    formats::SnapshotEnd end;
    end.ended = ended;
    if (result) {
        end.steps = result->steps;
        end.simulated_seconds = result->simulated_seconds;
        end.state_hash = result->state_hash;
        end.wall_seconds = result->wall_seconds;
        end.warnings = result->warnings;
    } else {
        for (const Error& error : result.errors()) end.warnings.push_back(formats::format(error));
    }
    throwIfRefused(snapshots_->finish(end));
    if (snapshots_->secondsWaited() > kWorthSaying)
        note(options_.common,
             "note: the run waited " + text(snapshots_->secondsWaited(), 2) + " s for the disk");
}

std::uint64_t RunRecorder::bytes() const { return snapshots_ ? snapshots_->bytesWritten() : 0; }

Json RunRecorder::facts() const {
    if (!snapshots_) return nullptr;
    return {{"frames", frames_},
            {"full_states", fulls_},
            {"bytes", snapshots_->bytesWritten()},
            {"seconds_waited_for_disk", number(snapshots_->secondsWaited())}};
}

std::string RunRecorder::lines() const {
    if (history_) return "history in " + options_.output + "\n";
    if (!snapshots_) return "";
    const std::string& path = options_.output.empty() ? options_.resume : options_.output;
    return std::to_string(frames_) + (resumed_ ? " more" : "") + " frames, " + std::to_string(fulls_) +
           " of them with the full state, in " + path + " (" +
           text(static_cast<double>(snapshots_->bytesWritten()) / 1e6, 2) + " MB)\n";
}

}  // namespace talus::tools
