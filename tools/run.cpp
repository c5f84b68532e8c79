// talus run: time history of a scenario; energies and watched blocks go to a CSV file row by row.

#include <filesystem>
#include <memory>
#include <optional>

#include "command.h"
#include "talus/formats/history.h"
#include "talus/simulation.h"

namespace talus::tools {

namespace {

struct RunOptions {
    Common common;
    std::string scenario, output;
    bool force = false;
};

/// A finished history, or a file of another kind, is only replaced when the user says so.
void refuseToOverwrite(const RunOptions& options) {
    std::error_code absent;
    if (std::filesystem::equivalent(options.output, options.scenario, absent))
        throw BadInput(Error{"--output", "is the scenario itself; choose another file", options.output});
    if (options.force) return;
    const formats::HistoryFile found = formats::inspectHistory(options.output);
    const bool finished = found == formats::HistoryFile::finished;
    if (finished || found == formats::HistoryFile::foreign)
        throw BadInput(Error{"--output",
                             finished
                                 ? "holds a finished history; --force replaces it, or choose another file"
                                 : "exists and is not a history; --force replaces it, or choose another file",
                             options.output});
}

void throwIfRefused(const std::vector<Error>& errors) {
    if (!errors.empty()) throw FileRefused(errors.front().field + ": " + errors.front().message);
}

/// The history file of a run, or nothing without -o.
std::optional<formats::HistoryWriter> openHistory(const RunOptions& options,
                                                  const formats::Scenario& scenario) {
    if (options.output.empty()) {
        note(options.common, "note: without -o FILE no history is written");
        return std::nullopt;
    }
    refuseToOverwrite(options);
    auto writer = formats::HistoryWriter::open(
        options.output, provenanceComments(options.common, scenario.path), scenario.model.run.watch);
    throwIfRefused(writer.errors());
    return std::move(*writer);
}

Json watchJson(const RunResult& result) {
    Json watch = Json::object();
    for (const BlockReport& block : result.watch)
        watch[block.name] = {{"position_m", vector(block.position)},
                             {"velocity_m_s", vector(block.velocity)},
                             {"rotation_deg", number(degrees(block.rotation))},
                             {"displacement_m", vector(block.displacement)}};
    return watch;
}

Json toJson(const RunOptions& options, const RunResult& result) {
    return {{"steps", result.steps},
            {"simulated_seconds", number(result.simulated_seconds)},
            {"time_step_s", number(result.time_step)},
            {"blocks", result.blocks},
            {"interfaces", result.interfaces},
            {"contact_points", result.contact_points},
            {"kinetic_energy_j", number(result.kinetic_energy)},
            {"state_hash", hashText(result.state_hash)},
            {"wall_seconds", number(result.wall_seconds)},
            {"watch", watchJson(result)},
            {"interrupted", result.interrupted},
            {"warnings", result.warnings},
            {"output", options.output.empty() ? Json(nullptr) : Json(options.output)},
            {"provenance", provenance(options.common, options.scenario)}};
}

std::string triple(const Vec3& value, int decimals) {
    return "(" + text(value.x(), decimals) + ", " + text(value.y(), decimals) + ", " +
           text(value.z(), decimals) + ")";
}

std::string toText(const RunOptions& options, const RunResult& result) {
    std::string lines =
        options.scenario + ": " + (result.interrupted ? "interrupted after " : "") +
        text(result.simulated_seconds, 6) + " s simulated in " + std::to_string(result.steps) + " steps of " +
        text(result.time_step * 1e6, 4) + " us, " + text(result.wall_seconds, 2) + " s\n" +
        std::to_string(result.blocks) + " blocks, " + std::to_string(result.interfaces) + " interfaces, " +
        std::to_string(result.contact_points) + " contact points\n" + "kinetic energy " +
        text(result.kinetic_energy, 9) + " J, state hash " + hashText(result.state_hash) + "\n";
    for (const BlockReport& block : result.watch)
        lines += block.name + ": at " + triple(block.position, 6) + " m, velocity " +
                 triple(block.velocity, 6) + " m/s, moved " + text(block.displacement.norm(), 9) +
                 " m, turned " + text(degrees(block.rotation), 5) + " deg\n";
    for (const std::string& warning : result.warnings) lines += "warning: " + warning + "\n";
    if (!options.output.empty()) lines += "history in " + options.output + "\n";
    return lines;
}

int runScenario(const RunOptions& options) {
    const formats::Scenario scenario = loadScenario(options.scenario, options.common);
    auto history = openHistory(options, scenario);
    std::vector<Error> refused;
    const auto record = [&](const HistoryRecord& row) {
        if (!history || !refused.empty()) return;
        refused = history->write(row);
        if (!refused.empty()) requestStop();
    };
    ProgressPrinter progress(options.common);
    const RunResult result =
        valueOf(run(scenario.model, controlOf(options.common, progress), record), scenario);
    progress.finish();
    throwIfRefused(refused);
    if (history) throwIfRefused(history->finish(result.interrupted ? "interrupted" : "finished"));
    if (options.common.json) {
        printJson(toJson(options, result));
    } else {
        printText(toText(options, result));
    }
    return result.interrupted ? kInterrupted : kDone;
}

}  // namespace

Command addRun(CLI::App& root) {
    auto options = std::make_shared<RunOptions>();
    CLI::App* app = root.add_subcommand("run", "Time history of a scenario");
    app->add_option("SCENARIO", options->scenario, "Scenario file (TOML)")->required();
    app->add_option("-o,--output", options->output,
                    "CSV file for the history: energies and the blocks of run.watch, written row by row");
    app->add_flag("--force", options->force, "Replace the output file even if it is a finished history");
    addCommon(*app, options->common);
    app->footer(
        "Example:\n  talus run slope.toml -o history.csv\n\nA row is written every run.frame_interval_s. "
        "Ctrl-C "
        "ends the run and keeps what was written.");
    return {app, [options] { return runScenario(*options); }};
}

}  // namespace talus::tools
