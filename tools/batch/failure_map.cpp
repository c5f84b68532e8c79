#include "batch/failure_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <unordered_map>

#include "batch/failure_on_face.h"
#include "batch/summary.h"
#include "cli/block_names.h"
#include "cli/failures.h"
#include "report/numbers.h"
#include "talus/formats/rock_region.h"
#include "talus/parallel.h"

namespace talus::tools::batch {

namespace {

/// Runs whose failures are held at once before they are added up, in their order.
constexpr std::size_t kRunsAtOnce = 256;
/// Relative: volumes of equal blocks differ by rounding, those of other blocks by more.
constexpr double kSameVolume = 1e-9;

/// Texts between kBetweenGroups.
std::vector<std::string> piecesOf(std::string_view text) {
    const std::string_view between = kBetweenGroups;
    std::vector<std::string> pieces;
    while (!text.empty()) {
        const std::size_t end = text.find(between);
        pieces.emplace_back(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + between.size());
    }
    return pieces;
}

/// Adds another group's failure; a cell on an edge of both counts once.
void addTo(FailureOnFace& all, FailureOnFace one) {
    all.volume += one.volume;
    all.hidden_volume += one.hidden_volume;
    std::vector<FailureOnFace::Share> both;
    const auto add = [&](const FailureOnFace::Share& share) {
        if (!both.empty() && both.back().cell == share.cell)
            both.back().volume_per_area += share.volume_per_area;
        else
            both.push_back(share);
    };
    std::size_t a = 0, b = 0;
    while (a < all.cells.size() || b < one.cells.size()) {
        const bool first =
            b == one.cells.size() || (a < all.cells.size() && all.cells[a].cell <= one.cells[b].cell);
        add(first ? all.cells[a++] : one.cells[b++]);
    }
    all.cells = std::move(both);
}

/// Sampled anew, so that only what fails is kept on disk.
class Failures {
 public:
    Failures(const formats::Sweep& sweep, const StoredBatch& batch, const Face& face)
        : sweep_(sweep),
          batch_(batch),
          index_(face),
          moving_(*batch.info.find("moving_blocks")),
          count_(*batch.info.find("moving_count")),
          volume_(*batch.info.find("failing_volume_m3")) {}

    FailureOnFace of(std::uint64_t run) const {
        const auto sampled = formats::scenarioOf(sweep_, formats::runOf(sweep_, run));
        if (!sampled) refuse(run, "its scenario cannot be read: " + sampled.errors().front().message);
        const Model& model = sampled->scenario.model;
        const Row row = batch_.row(run);
        const auto groups = failingGroups(row);
        FailureOnFace all;
        for (const auto& names : groups) {
            FailureOnFace one = index_.failureOf(model, numbersOf(model, names, run));
            if (&names == &groups.front()) checkFirst(row, run, names.size(), one.volume);
            addTo(all, std::move(one));
        }
        return all;
    }

 private:
    /// The blocks that fail first, and groups that fail after them at factors up to the threshold.
    std::vector<std::vector<std::string>> failingGroups(const Row& row) const {
        std::vector<std::vector<std::string>> groups{expandedNames(row[moving_])};
        const auto factors = batch_.info.find(kGroupFactors), blocks = batch_.info.find(kGroupBlocks);
        if (!factors || !blocks) return groups;
        const auto numbers = piecesOf(row[*factors]), names = piecesOf(row[*blocks]);
        for (std::size_t g = 1; g < std::min(numbers.size(), names.size()); ++g)
            if (numberIn(numbers[g]).value_or(kInfinity) <= batch_.info.thresholds.front())
                groups.push_back(expandedNames(names[g]));
        return groups;
    }

    std::vector<std::size_t> numbersOf(const Model& model, const std::vector<std::string>& names,
                                       std::uint64_t run) const {
        std::unordered_map<std::string_view, std::size_t> known;
        for (std::size_t b = 0; b < model.blocks.size(); ++b) known.emplace(model.blocks[b].name, b);
        std::vector<std::size_t> numbers;
        for (const std::string& name : names) {
            const auto found = known.find(name);
            if (found == known.end()) refuse(run, "it has no block \"" + name + "\"");
            numbers.push_back(found->second);
        }
        return numbers;
    }

    void checkFirst(const Row& row, std::uint64_t run, std::size_t count, double volume) const {
        if (std::to_string(count) != row[count_])
            refuse(run, "it lists " + std::to_string(count) + " failing blocks and counts " + row[count_]);
        const double told = numberIn(row[volume_]).value_or(0);
        if (!(std::abs(volume - told) <= kSameVolume * told))
            refuse(run, "its failing blocks have " + csvNumber(volume) + " m3, and the row says " +
                            csvNumber(told));
    }

    [[noreturn]] void refuse(std::uint64_t run, const std::string& why) const {
        throw BadInput(Error{"results.csv", "the row of run " + std::to_string(run) +
                                                " does not fit its sample: " + why +
                                                "; allowed: rows of this version and these files"});
    }

    const formats::Sweep& sweep_;
    const StoredBatch& batch_;
    FaceIndex index_;
    std::size_t moving_, count_, volume_;  ///< columns
};

/// The failures of these runs, each by one thread. Nothing when it was stopped.
std::optional<std::vector<FailureOnFace>> computeFailures(const Failures& failures,
                                                          const std::vector<std::uint64_t>& runs, int threads,
                                                          const std::atomic<bool>& stop) {
    std::vector<FailureOnFace> found(runs.size());
    std::vector<std::exception_ptr> faults(runs.size());
    inArena(threads, [&] {
        tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t k) {
            if (stop) return;
            try {
                found[k] = failures.of(runs[k]);
            } catch (...) {
                faults[k] = std::current_exception();
            }
        });
    });
    for (const std::exception_ptr& fault : faults)
        if (fault) std::rethrow_exception(fault);
    if (stop) return std::nullopt;
    return found;
}

void add(const FailureOnFace& failure, FailureMap& map) {
    for (const FailureOnFace::Share& share : failure.cells) {
        ++map.hits[share.cell];
        map.volume_per_area[share.cell] += share.volume_per_area;
    }
    map.volume += failure.volume;
    map.hidden_volume += failure.hidden_volume;
}

/// From sums to means.
void finish(FailureMap& map) {
    const double runs = static_cast<double>(std::max<std::uint64_t>(map.runs, 1));
    for (double& volume : map.volume_per_area) volume /= runs;
    map.volume /= runs;
    map.hidden_volume /= runs;
}

/// Refuses a map that a sweep cannot have.
class Refusal {
 public:
    explicit Refusal(const char* name) : name_(name) {}
    [[noreturn]] void operator()(const std::string& found, const std::string& allowed) const {
        throw BadInput(Error{name_, "found " + found + ", allowed: " + allowed});
    }

 private:
    const char* name_;
};

void refuseVariedRegion(const formats::Sweep& sweep, const Refusal& refuse) {
    for (const formats::SweepColumn& column : sweep.columns)
        for (const std::string& target : column.targets)
            if (target.starts_with("rock_mass.region"))
                refuse("a sweep that varies " + target,
                       "one region for all samples, since the map is of one face");
}

}  // namespace

double FailureMap::probability(std::size_t cell) const {
    return runs > 0 ? static_cast<double>(hits[cell]) / static_cast<double>(runs) : 0;
}

double FailureMap::largestProbability() const {
    const auto most = std::max_element(hits.begin(), hits.end());
    return most == hits.end() ? 0 : probability(static_cast<std::size_t>(most - hits.begin()));
}

double FailureMap::largestVolumePerArea() const {
    const auto most = std::max_element(volume_per_area.begin(), volume_per_area.end());
    return most == volume_per_area.end() ? 0 : *most;
}

Interval FailureMap::interval(std::size_t cell) const { return shareInterval(hits[cell], runs, confidence); }

Face faceOf(const formats::Sweep& sweep, const BatchInfo& info, std::optional<double> cell_size,
            const MapNames& names) {
    const Refusal refuse(names.map);
    if (sweep.search == nullptr)
        refuse("analysis = \"run\"", "an analysis that searches for a failure, such as \"safety-factor\"");
    if (info.thresholds.empty())
        refuse("no load for the probability of failure",
               "[report] with " + std::string(sweep.search->load->key));
    if (info.cases > 1)
        refuse("a sweep of " + std::to_string(info.cases) + " cases",
               "one case, that is random variables without grids or tables of several rows");
    refuseVariedRegion(sweep, refuse);
    auto region = formats::rockRegion(sweep.scenario_text, sweep.scenario_path);
    if (!region) throw BadInput(region.errors());
    if (!*region) refuse("a scenario without [rock_mass]", "one with a region that joints cut");
    auto face = divideFace(**region, cell_size);
    if (!face)
        Refusal(names.cell_size)(csvNumber(cell_size.value_or(0)) + " m, which makes more than " +
                                     std::to_string(kMostCells) + " cells",
                                 "larger cells");
    return *std::move(face);
}

std::optional<FailureMap> failureMap(const formats::Sweep& sweep, const StoredBatch& batch, Face face,
                                     int threads, const std::atomic<bool>& stop,
                                     const std::function<void(const Progress&)>& progress) {
    FailureMap map;
    map.face = std::move(face);
    map.hits.assign(map.face.cells.size(), 0);
    map.volume_per_area.assign(map.face.cells.size(), 0);
    map.threshold = batch.info.thresholds.front();
    map.confidence = batch.info.confidence;
    std::vector<std::uint64_t> failed;
    for (const Observation& seen : summarise(batch).observations) {
        const auto fails = hasFailed(seen, seen.answer, map.threshold);
        map.runs += fails.has_value();
        if (fails.value_or(false)) failed.push_back(seen.run);
    }
    map.failed = failed.size();
    const Failures failures(sweep, batch, map.face);
    for (std::size_t first = 0; first < failed.size(); first += kRunsAtOnce) {
        const std::size_t end = std::min(failed.size(), first + kRunsAtOnce);
        const auto found = computeFailures(failures,
                                           {failed.begin() + static_cast<std::ptrdiff_t>(first),
                                            failed.begin() + static_cast<std::ptrdiff_t>(end)},
                                           threads, stop);
        if (!found) return std::nullopt;
        for (const FailureOnFace& failure : *found) add(failure, map);
        if (progress)
            progress({"map", static_cast<double>(end) / static_cast<double>(failed.size()), "failed runs"});
    }
    finish(map);
    return map;
}

}  // namespace talus::tools::batch
