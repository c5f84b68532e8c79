#include "batch/outcome.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>

#include "batch/map_files.h"
#include "batch/map_on_slope.h"
#include "batch/report.h"
#include "cli/failures.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/provenance.h"
#include "cli/text.h"

namespace talus::tools::batch {

namespace {

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

/// A page in place of the batch's own report would be lost, or take its place.
void refuseOwnPage(const char* option, const std::string& folder, const std::string& path) {
    namespace fs = std::filesystem;
    std::error_code none;
    if (fs::weakly_canonical(path, none) == fs::weakly_canonical(folder + "/" + kPageName, none))
        throw BadInput(Error{option, "is the batch's own report; choose another file", path});
}

/// What a map is drawn on.
struct Ground {
    Face face;
    std::optional<Slope> slope;
};

/// And files that can be written: before a long computation.
std::optional<Ground> groundForMap(const formats::Sweep& sweep, const BatchRequest& request) {
    if (!request.wantsMap()) return std::nullopt;
    const char* option = request.maps.empty() ? "--map-3d" : "--map";
    if (!request.shard.whole())
        throw BadInput(Error{option,
                             "found together with --shard, allowed: after talus merge, by the same command "
                             "without --shard"});
    Ground ground{faceOf(sweep, describe(sweep), request.map_cell, {option}), {}};
    for (const std::string& path : request.maps) {
        refuseOwnPage("--map", request.folder, path);
        refuseMapFile(path, ground.face);
    }
    if (request.map_3d.empty()) return ground;
    refuseOwnPage("--map-3d", request.folder, request.map_3d);
    refuseSlopePage(request.map_3d, ground.face);
    if (std::find(request.maps.begin(), request.maps.end(), request.map_3d) != request.maps.end())
        throw BadInput(Error{"--map-3d", "is a file of --map, too; choose another file", request.map_3d});
    ground.slope = slopeOf(sweep);
    return ground;
}

/// Of the rows of one shard: its folder may hold those of others.
std::vector<WarningGroup> warningsOf(StoredBatch stored, const Shard& shard) {
    for (auto line = stored.lines.begin(); line != stored.lines.end();)
        line = shard.has(stored.info, line->first) ? std::next(line) : stored.lines.erase(line);
    return summarise(stored).warnings;
}

/// Nothing when it was stopped.
std::optional<FailureMap> writeMaps(const formats::Sweep& sweep, const StoredBatch& stored, Ground ground,
                                    const BatchRequest& request, const std::atomic<bool>& stop) {
    auto map = failureMap(sweep, stored, std::move(ground.face), threadsUsed(request.common), stop,
                          request.progress);
    if (!map) return std::nullopt;
    for (const std::string& path : request.maps)
        writeFile(path, mapFile(path, *map, stored.info, request.common));
    if (ground.slope) writeFile(request.map_3d, mapOnSlope(*map, stored.info, *ground.slope, request.common));
    return map;
}

}  // namespace

BatchOutcome computeBatch(const formats::Sweep& sweep, const BatchRequest& request,
                          const std::atomic<bool>& stop) {
    const auto begin = std::chrono::steady_clock::now();
    std::optional<Ground> ground = groundForMap(sweep, request);
    Store store(request.folder, describe(sweep), request.shard);
    const BatchWork batch{sweep,
                          store,
                          request.shard,
                          threadsUsed(request.common),
                          request.retry,
                          caseCosts(sweep),
                          stop,
                          request.abandon,
                          [&](const BatchProgress& p) {
                              if (request.progress) request.progress(shownProgress(p));
                          }};
    const BatchProgress progress = request.work(batch);
    if (const int error = store.sync(); error != 0)
        throw FileRefused(store.resultsPath(), "cannot be written", error);
    BatchOutcome outcome{
        .runs = shardRuns(store, request.shard),
        .done = store.doneCount(),
        .failed = store.failedCount(),
        .computed = progress.done,
        .wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
        .interrupted = stop.load(),
        .identity = store.info().identity,
        .results = store.resultsPath(),
        .seed = store.info().seed};
    if (!request.shard.whole()) {
        StoredBatch rows = onlyRunsOf(store.info(), readStored(request.folder, request.shard));
        outcome.beyond = rows.beyond;
        outcome.warnings = warningsOf(std::move(rows), request.shard);
        return outcome;
    }
    const StoredBatch stored = onlyRunsOf(store.info(), readStored(request.folder));
    outcome.beyond = stored.beyond;
    outcome.warnings = writeReport(request.folder, stored, request.common).warnings;
    if (ground && !stop) outcome.map = writeMaps(sweep, stored, *std::move(ground), request, stop);
    return outcome;
}

std::vector<std::string> BatchRequest::mapFiles() const {
    std::vector<std::string> files = maps;
    if (!map_3d.empty()) files.push_back(map_3d);
    return files;
}

Json batchJson(const BatchOutcome& outcome, const BatchRequest& request) {
    const bool whole = request.shard.whole();
    return {{"runs", outcome.runs},
            {"done", outcome.done},
            {"failed", outcome.failed},
            {"computed", outcome.computed},
            {"rows_beyond", outcome.beyond},
            {"wall_seconds", number(outcome.wall_seconds)},
            {"interrupted", outcome.interrupted},
            {"identity", outcome.identity},
            {"seed", outcome.seed},
            {"results", outcome.results},
            {"warnings", toJson(outcome.warnings)},
            {"summary", whole ? Json(request.folder + "/summary.json") : Json(nullptr)},
            {"page", whole ? Json(request.folder + "/report.html") : Json(nullptr)},
            {"map", outcome.map ? toJson(*outcome.map, request.mapFiles()) : Json(nullptr)},
            {"provenance", provenance(request.common, request.sweep)}};
}

}  // namespace talus::tools::batch
