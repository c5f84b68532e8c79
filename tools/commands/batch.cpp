// talus batch: sweeps, Monte Carlo, reliability.

#include <CLI/CLI.hpp>
#include <charconv>
#include <memory>

#include "batch/mpi.h"
#include "batch/report.h"
#include "batch/schedule.h"
#include "batch/store.h"
#include "cli/failures.h"
#include "cli/json.h"
#include "cli/progress.h"
#include "cli/provenance.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "commands/commands.h"

namespace talus::tools {

namespace {

using namespace batch;

struct BatchOptions {
    Common common;
    std::string sweep, folder, shard;
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

std::string rateText(const BatchProgress& progress) {
    const double rate = progress.seconds > 0 ? static_cast<double>(progress.done) / progress.seconds : 0;
    return std::to_string(progress.done) + " of " + std::to_string(progress.todo) + " runs, " +
           (rate >= 1 || rate == 0 ? text(rate, 1) + " a second" : text(1 / rate, 1) + " s each") +
           (progress.failed ? ", " + std::to_string(progress.failed) + " failed" : "");
}

Progress shownProgress(const BatchProgress& progress) {
    const double fraction =
        progress.todo ? static_cast<double>(progress.done) / static_cast<double>(progress.todo) : 1;
    return {"batch", fraction, rateText(progress)};
}

std::uint64_t shardRuns(const Store& store, const Shard& shard) {
    if (shard.whole()) return store.info().runs;
    std::uint64_t count = 0;
    for (std::uint64_t run = 0; run < store.info().runs; ++run) count += shard.has(store.info(), run);
    return count;
}

struct Tally {
    std::uint64_t runs = 0, done = 0, failed = 0, computed = 0;
    double wall_seconds = 0;
};

Json toJson(const BatchOptions& options, const Store& store, const Tally& tally) {
    return {{"runs", tally.runs},
            {"done", tally.done},
            {"failed", tally.failed},
            {"computed", tally.computed},
            {"wall_seconds", number(tally.wall_seconds)},
            {"interrupted", stopRequested().load()},
            {"identity", store.info().identity},
            {"seed", store.info().seed},
            {"results", store.resultsPath()},
            {"summary", options.shard.empty() ? Json(options.folder + "/summary.json") : Json(nullptr)},
            {"page", options.shard.empty() ? Json(options.folder + "/report.html") : Json(nullptr)},
            {"provenance", provenance(options.common, options.sweep)}};
}

std::string toText(const BatchOptions& options, const Store& store, const Tally& tally) {
    std::string lines = std::to_string(tally.done) + " of " + std::to_string(tally.runs) + " runs done" +
                        (tally.failed ? ", " + std::to_string(tally.failed) + " of them failed" : "") + "; " +
                        std::to_string(tally.computed) + " computed now in " + text(tally.wall_seconds, 1) +
                        " s\n";
    if (tally.done < tally.runs)
        lines += stopRequested() ? "interrupted: the same command goes on from here\n"
                                 : "the others are being computed by another process\n";
    lines += "results in " + store.resultsPath() + "\n";
    if (options.shard.empty())
        lines += "report in " + options.folder + "/report.html\n";
    else
        lines += "once all shards are done: talus merge " + options.folder + "\n";
    return lines;
}

int exitCode(const Tally& tally) {
    if (stopRequested()) return kInterrupted;
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
        printText(lines);
    return kDone;
}

int runBatch(const BatchOptions& options) {
    const Shard shard = shardOf(options.shard);
    const formats::Sweep sweep = valueOf(formats::readSweep(options.sweep));
    if (options.plan) return showPlan(options, sweep);
    if (options.folder.empty())
        throw BadInput(Error{"--output", "missing; allowed: -o DIR, the folder for the results (or --plan)"});
    const MpiJob
        job;  // input that is bad for one process is bad for all: they say so and leave before they meet
    if (job.rank() > 0) {
        job.help(sweep, describe(sweep), stopRequested());
        return kDone;  // what there is to say, process 0 says
    }
    const auto begin = std::chrono::steady_clock::now();
    Store store(options.folder, describe(sweep), shard);
    ProgressPrinter printer(options.common);
    const BatchWork batch{sweep,
                          store,
                          shard,
                          threadsUsed(options.common),
                          options.retry,
                          caseCosts(sweep),
                          stopRequested(),
                          requestStop,
                          [&](const BatchProgress& p) { printer.show(shownProgress(p)); }};
    const BatchProgress progress = job.size() > 1 ? job.serve(batch) : work(batch);
    printer.finish();
    if (const int error = store.sync(); error != 0)
        throw FileRefused(store.resultsPath(), "cannot be written", error);
    const Tally tally{shardRuns(store, shard), store.doneCount(), store.failedCount(), progress.done,
                      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()};
    if (shard.whole()) writeReport(options.folder, readStored(options.folder), options.common);
    if (options.common.json)
        printJson(toJson(options, store, tally));
    else
        printText(toText(options, store, tally));
    return exitCode(tally);
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
                    "Compute part I of N only (I/N, from 1), into a file of its own");
    app->add_flag("--retry", options->retry, "Compute failed and undecided runs again");
    app->add_flag("--plan", options->plan, "Only show how many runs there are, and the first samples");
    addCommon(*app, options->common);
    app->footer(
        "Example:\n  talus batch bench/sweeps/monte-carlo.toml -o out\n  talus batch sweep.toml -o out "
        "--shard "
        "$SLURM_ARRAY_TASK_ID/8   (then: talus merge out)\n\nEach run is one row of results.csv. The same "
        "command goes "
        "on where a batch was stopped, and may run in several\nprocesses on one folder. Exit code 3: some "
        "runs failed "
        "or ended undecided; their rows say why.");
    return {app, [options] { return runBatch(*options); }};
}

}  // namespace talus::tools
