// talus batch: sweeps, Monte Carlo, reliability.

#include <CLI/CLI.hpp>
#include <charconv>
#include <memory>

#include "batch/mpi.h"
#include "batch/outcome.h"
#include "batch/report.h"
#include "batch/schedule.h"
#include "cli/failures.h"
#include "cli/json.h"
#include "cli/progress.h"
#include "cli/scenario.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "commands/commands.h"

namespace talus::tools {

namespace {

using namespace batch;

struct BatchOptions {
    Common common;
    std::string sweep, folder, shard;
    std::vector<std::string> maps;
    std::string map_3d;
    std::optional<double> map_cell;
    bool retry = false, plan = false;
};

/// "2/8"
Shard shardOf(const std::string& text) {
    if (text.empty()) return {};
    Shard shard{0, 0};
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, shard.index);
    if (first.ec == std::errc() && first.ptr != end && *first.ptr == '/') {
        const auto second = std::from_chars(first.ptr + 1, end, shard.count);
        if (second.ec == std::errc() && second.ptr == end && shard.index >= 1 && shard.index <= shard.count)
            return shard;
    }
    throw BadInput(Error{"--shard", "found \"" + text + "\", allowed: I/N with I from 1 to N, like 2/8"});
}

std::string toText(const BatchOptions& options, const std::vector<std::string>& maps,
                   const BatchOutcome& tally) {
    std::string lines = std::to_string(tally.done) + " of " + std::to_string(tally.runs) + " runs done" +
                        (tally.failed ? ", " + std::to_string(tally.failed) + " of them failed" : "") + "; " +
                        std::to_string(tally.computed) + " computed now in " + text(tally.wall_seconds, 1) +
                        " s\n";
    if (tally.done < tally.runs)
        lines += tally.interrupted ? "interrupted: run the same command again to continue\n"
                                   : "another process is computing the others\n";
    if (tally.beyond > 0) lines += rowsBeyond(tally.beyond, tally.results) + "\n";
    lines += warningLines(tally.warnings, tally.done) + "results in " + tally.results + "\n";
    if (options.shard.empty())
        lines += "report in " + options.folder + "/report.html\n";
    else
        lines += "when all shards are done, run: talus merge " + options.folder + "\n";
    if (!tally.map) return lines;
    lines += "probability of failure: at most " + text(100 * tally.map->largestProbability(), 1) +
             " % at a place of the face; expected failing volume " + text(tally.map->volume, 3) + " m3\n";
    for (const std::string& map : maps) lines += "map in " + map + "\n";
    return lines;
}

int exitCode(const BatchOutcome& tally) {
    if (tally.interrupted) return kInterrupted;
    return tally.failed > 0 ? kUndecided : kDone;
}

int showPlan(const BatchOptions& options, const formats::Sweep& sweep) {
    const BatchInfo info = describe(sweep);
    Json samples = Json::array();
    std::string lines = std::to_string(info.runs) + " runs: " + std::to_string(info.cases) + " cases x " +
                        std::to_string(info.samples) + " samples, " + info.analysis + " of " + info.scenario +
                        ", identity " + info.identity + "\n";
    for (std::uint64_t index = 0; index < std::min<std::uint64_t>(info.runs, 10); ++index) {
        const formats::SweepRun run = formats::runOf(sweep, index);
        Json sample{{"run", index}};
        lines += "run " + std::to_string(index) + ":";
        for (std::size_t c = 0; c < sweep.columns.size(); ++c) {
            if (sweep.columns[c].per == formats::SampledPer::interface) continue;
            sample[sweep.columns[c].name] = formats::toString(run.values[c]);
            lines += " " + sweep.columns[c].name + " = " + formats::toString(run.values[c]);
        }
        lines += "\n";
        samples.push_back(std::move(sample));
    }
    if (info.runs > 10) lines += "...\n";
    if (options.common.json)
        printJson({{"runs", info.runs},
                   {"cases", info.cases},
                   {"samples", info.samples},
                   {"identity", info.identity},
                   {"first", samples}});
    else
        printResult(lines);
    return kDone;
}

int runBatch(const BatchOptions& options) {
    const Shard shard = shardOf(options.shard);
    const formats::Sweep sweep = [&] {
        const EndsAtOnce reading = whileReading(options.sweep, options.common);
        return valueOf(formats::readSweep(options.sweep));
    }();
    if (options.plan) return showPlan(options, sweep);
    if (options.folder.empty())
        throw BadInput(Error{"--output", "missing; allowed: -o DIR, the folder for the results (or --plan)"});
    const MpiJob job;  // bad input is bad for all processes: each reports it and ends before they synchronise
    if (job.rank() > 0) {
        job.help(sweep, describe(sweep), stopRequested());
        return kDone;  // what there is to report, process 0 reports
    }
    ProgressPrinter printer(options.common, Fraction::of_time);
    const BatchRequest request{
        .common = options.common,
        .sweep = options.sweep,
        .folder = options.folder,
        .shard = shard,
        .retry = options.retry,
        .maps = options.maps,
        .map_3d = options.map_3d,
        .map_cell = options.map_cell,
        .abandon = requestStop,
        .progress = printer.callback(),
        .work = [&](const BatchWork& batch) { return job.size() > 1 ? job.serve(batch) : work(batch); }};
    const BatchOutcome outcome = computeBatch(sweep, request, stopRequested());
    printer.finish();
    if (options.common.json)
        printJson(batchJson(outcome, request));
    else
        printResult(toText(options, request.mapFiles(), outcome));
    return exitCode(outcome);
}

}  // namespace

Command addBatch(CLI::App& root) {
    auto options = std::make_shared<BatchOptions>();
    CLI::App* app =
        root.add_subcommand("batch", "Sweeps, Monte Carlo and reliability: many runs of one scenario");
    app->add_option("SWEEP", options->sweep, "Sweep file (TOML): scenario, analysis and what varies")
        ->required();
    app->add_option("-o,--output", options->folder, "Folder for results.csv, summary.json and report.html");
    app->add_option("--shard", options->shard,
                    "Compute only part I of N (I/N, from 1) and write it to a file of its own");
    app->add_flag("--retry", options->retry, "Compute failed and undecided runs again");
    app->add_flag("--plan", options->plan,
                  "Print the number of runs and the first samples, and compute nothing");
    app->add_option(
           "--map", options->maps,
           "Write the probability of failure over the face of a rock mass to FILE: .html (page), .vtp "
           "or .ply; may be given several times")
        ->type_name("FILE")
        ->allow_extra_args(false);
    app->add_option("--map-3d", options->map_3d,
                    "Write the same map on the blocks of the scenario, as a page to turn and zoom")
        ->type_name("FILE.html");
    app->add_option("--map-cell", options->map_cell, "Size of the map's cells in m (default: 2,000 cells)")
        ->check(CLI::PositiveNumber);
    addCommon(*app, options->common);
    app->footer(
        "Example:\n  talus batch bench/sweeps/monte-carlo.toml -o out\n  talus batch sweep.toml -o out "
        "--shard $SLURM_ARRAY_TASK_ID/8   (then: talus merge out)\n\nEach run is one row of results.csv. Run "
        "the same command again to continue a batch that was stopped. Several\nprocesses may work on one "
        "folder. With range = true in the sweep, each run also searches for a lower answer on\nanother "
        "loading path. Exit code 3: some runs failed or are undecided; their rows give the reason.");
    return {app, [options] { return runBatch(*options); }};
}

}  // namespace talus::tools
