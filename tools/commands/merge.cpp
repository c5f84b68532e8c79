// talus merge: the results of shards, or of several folders, as one batch with its summary.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "batch/report.h"
#include "batch/store.h"
#include "cli/failures.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/text.h"
#include "commands/commands.h"

namespace talus::tools {

namespace {

using namespace batch;

struct MergeOptions {
    Common common;
    std::vector<std::string> folders;
    std::string output;
};

/// All rows of all folders; a result stands before a failure of the same run.
StoredBatch merged(const std::vector<std::string>& folders) {
    StoredBatch all = readStored(folders.front());
    for (std::size_t i = 1; i < folders.size(); ++i) {
        StoredBatch more = readStored(folders[i]);
        if (more.info.identity != all.info.identity)
            throw BadInput(Error{
                "", "holds a different sweep from " + folders.front() + ", allowed: folders of one sweep",
                folders[i]});
        if (csvHeader(more.info) != csvHeader(all.info))
            throw BadInput(Error{"",
                                 "has other columns than " + folders.front() +
                                     ", as of another version; allowed: folders of one version",
                                 folders[i]});
        if (more.info.runs > all.info.runs) all.info = more.info;
        for (auto& [run, line] : more.lines) keepBetter(all, run, std::move(line));
    }
    return all;
}

int merge(const MergeOptions& options) {
    const std::string folder = options.output.empty() ? options.folders.front() : options.output;
    if (!options.output.empty()) makeFolder(folder);
    // A folder without a batch, or with another one, is reported before a lock is put into it.
    refuseToReplaceOther(folder, readStored(options.folders.front()).info);
    const AloneIn alone(folder);  // rows that come after they were read would be lost
    const StoredBatch all = merged(options.folders);
    refuseToReplaceOther(folder, all.info);
    std::vector<std::uint64_t> runs;
    for (const auto& entry : all.lines) runs.push_back(entry.first);
    std::sort(runs.begin(), runs.end());
    std::string csv = csvHeader(all.info);
    std::uint64_t failed = 0;
    const std::size_t status = *all.info.find("status");
    for (const std::uint64_t run : runs) {
        csv += all.lines.at(run) + '\n';
        failed += isFailure(all.row(run)[status]);
    }
    writeFile(folder + "/batch.json", jsonText(toJson(all.info), 2) + "\n");
    writeFile(folder + "/results.csv", csv);
    writeFile(folder + "/results.csv-metadata.json",
              jsonText(csvMetadata(all.info, "results.csv"), 2) + "\n");
    const auto warnings = writeReport(folder, all, options.common).warnings;
    const std::uint64_t missing = all.info.runs - std::min<std::uint64_t>(all.info.runs, runs.size());
    if (options.common.json)
        printJson({{"runs", all.info.runs},
                   {"done", runs.size()},
                   {"failed", failed},
                   {"missing", missing},
                   {"warnings", toJson(warnings)},
                   {"results", folder + "/results.csv"},
                   {"page", folder + "/report.html"}});
    else
        printResult(std::to_string(runs.size()) + " of " + std::to_string(all.info.runs) + " runs" +
                    (failed ? ", " + std::to_string(failed) + " of them failed" : "") + ", report in " +
                    folder + "/report.html\n" + warningLines(warnings, runs.size()));
    return missing > 0 || failed > 0 ? kUndecided : kDone;
}

}  // namespace

Command addMerge(CLI::App& root) {
    auto options = std::make_shared<MergeOptions>();
    CLI::App* app = root.add_subcommand("merge", "Merge the results of a batch's shards and report on them");
    app->add_option("DIR", options->folders,
                    "Folders of one batch, each with the results of one or more shards")
        ->required();
    app->add_option("-o,--output", options->output, "Folder for the merged results (default: the first DIR)");
    addCommon(*app, options->common, false);
    app->footer(
        "Example:\n  for i in 1 2 3 4; do talus batch sweep.toml -o out --shard $i/4 & done; wait\n  talus "
        "merge out\n\nAlso writes summary.json and report.html again. Exit code 3: runs are missing or "
        "failed.");
    return {app, [options] { return merge(*options); }};
}

}  // namespace talus::tools
