#include "batch/compute.h"

#include <cmath>
#include <ctime>
#include <limits>

#include "batch/warnings.h"
#include "cli/block_names.h"
#include "cli/text.h"
#include "talus/simulation.h"

namespace talus::tools::batch {

namespace {

using formats::SampledPer;
using formats::SampledScenario;
using formats::Sweep;
using formats::SweepRun;

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

/// A row that is filled by the columns' names, so that no order has to be kept in two places.
class RowWriter {
 public:
    explicit RowWriter(const BatchInfo& info) : info_(info), cells_(info.columns.size()) {}

    void set(const std::string& column, std::string text) {
        if (const auto index = info_.find(column)) cells_[*index] = std::move(text);
    }
    void set(const std::string& column, double value) { set(column, csvNumber(value)); }
    void set(const std::string& column, std::int64_t value) { set(column, std::to_string(value)); }
    void addReason(const std::string& text) {
        std::string& cell = cells_.back();
        if (!text.empty()) cell += (cell.empty() ? "" : "; ") + text;
    }
    void addWarnings(const std::vector<std::string>& warnings) {
        std::string& cell = cells_[*info_.find(kWarnings)];
        for (const std::string& warning : warnings) cell += (cell.empty() ? "" : kBetweenWarnings) + warning;
    }
    Row take() { return std::move(cells_); }

 private:
    const BatchInfo& info_;
    Row cells_;
};

void writeKeys(const Sweep& sweep, const SweepRun& run, RowWriter& row) {
    row.set("run", static_cast<std::int64_t>(run.index));
    row.set("case", static_cast<std::int64_t>(run.case_index));
    row.set("sample", static_cast<std::int64_t>(run.sample));
    if (!sweep.case_names.empty()) {
        const std::uint64_t grids = sweep.cases / sweep.case_names.size();
        row.set("name", sweep.case_names[run.case_index / grids]);
    }
    for (std::size_t c = 0; c < sweep.columns.size(); ++c)
        if (sweep.columns[c].per != SampledPer::interface) {
            const auto* real = std::get_if<double>(&run.values[c]);
            row.set(sweep.columns[c].name, real ? csvNumber(*real) : formats::toString(run.values[c]));
        }
}

void writeDrawn(const Sweep& sweep, const SampledScenario& sampled, RowWriter& row) {
    for (const formats::DrawnRange& drawn : sampled.drawn) {
        if (drawn.interfaces == 0) continue;
        const std::string& name = sweep.columns[drawn.column].name;
        row.set(name + ".mean", drawn.mean);
        row.set(name + ".min", drawn.min);
        row.set(name + ".max", drawn.max);
    }
}

void fail(RowWriter& row, const std::vector<Error>& errors) {
    row.set("status", std::string("failed"));
    for (const Error& error : errors)
        row.addReason((error.field.empty() ? "" : error.field + ": ") + error.message);
}

void writeInterval(const SearchResult& result, const LoadSearch& search, bool with_range, RowWriter& row) {
    if (!result.answer_interval) return;
    const double scale = search.load->scale;
    const auto [low, high] = *result.answer_interval;
    row.set(search.keyInUnit(kIntervalLow), low / scale);
    row.set(search.keyInUnit(kIntervalHigh), high / scale);
    if (!with_range) return;
    row.set("range_reason", result.answer_interval_reasons.first);
    if (!(low < result.answer)) return;
    row.set(search.keyInUnit(kRangeLow), low / scale);
    row.set(search.keyInUnit(kRangeHigh), result.answer / scale);
}

void writeGroups(const std::vector<BlockGroup>& groups, RowWriter& row) {
    std::string factors, blocks;
    for (const BlockGroup& group : groups) {
        const std::string between = &group == &groups.front() ? "" : kBetweenGroups;
        factors += between + csvNumber(group.factor);
        blocks += between + compactNames(group.blocks, kAll);
    }
    row.set(kGroupFactors, std::move(factors));
    row.set(kGroupBlocks, std::move(blocks));
}

void writeSearch(const SearchResult& result, const LoadSearch& search, const Model& model, bool with_range,
                 RowWriter& row) {
    row.set("status", std::string(toString(result.status)));
    if (result.status == SearchStatus::found) row.set(search.answer_key, result.answer / search.load->scale);
    row.set(search.keyInUnit("bracket_low"), result.low / search.load->scale);
    row.set(search.keyInUnit("bracket_high"), result.high / search.load->scale);
    if (result.upper_bound.value)
        row.set(search.keyInUnit(kCeiling), *result.upper_bound.value / search.load->scale);
    writeInterval(result, search, with_range, row);
    row.set("failing_volume_m3", result.failing_volume);
    row.set("failing_mass_kg", result.failing_mass);
    if (const auto theory = search.theory(model, nullptr))
        row.set(search.theory_key, theory->value / search.load->scale);
    row.set("failure_mode", std::string(toString(result.mode)));
    row.set("moving_count", static_cast<std::int64_t>(result.moving_blocks.size()));
    row.set("moving_mass_share", massShare(model, result.moving_blocks));
    row.set("moving_blocks", compactNames(result.moving_blocks, kAll));
    writeGroups(result.groups, row);
    row.set("left_out", compactNames(leftOut(result), kAll));
    row.set("probes", static_cast<std::int64_t>(result.probes.size()));
    row.set("steps", result.steps);
    row.set("state_hash", hashText(result.state_hash));
    if (result.status == SearchStatus::undecided)
        row.addReason(result.probes.empty() ? "undecided" : result.probes.back().reason);
    row.addWarnings(result.warnings);
}

void writeRun(const RunResult& result, RowWriter& row) {
    row.set("status", std::string("finished"));
    row.set("simulated_seconds", result.simulated_seconds);
    row.set("time_step_s", result.time_step);
    row.set("kinetic_energy_j", result.kinetic_energy);
    for (const BlockReport& block : result.watch) {
        row.set(block.name + ".displacement_m", block.displacement.norm());
        row.set(block.name + ".rotation_deg", degrees(block.rotation));
    }
    row.set("steps", result.steps);
    row.set("state_hash", hashText(result.state_hash));
    row.addWarnings(result.warnings);
}

/// False when it was interrupted.
bool analyse(const SampledScenario& sampled, const Sweep& sweep, const std::atomic<bool>& stop,
             RowWriter& row, bool& failed) {
    const LoadSearch* search = sweep.search;
    const Control control{.stop = &stop, .threads = 1, .groups = sweep.groups};
    const Model& model = sampled.scenario.model;
    if (!search) {
        const auto result = run(model, control, [](const HistoryRecord&) {});
        if (result && result->interrupted) return false;
        failed = !result;
        failed ? fail(row, result.errors()) : writeRun(*result, row);
        return true;
    }
    const auto result = search->find(model, control, {});
    if (stop) return false;  // what stands beside the answer may have been cut short, too
    // A draw whose joints free no block is a stable one.
    if (const auto none = formats::noFreeBlock(sampled.scenario)) row.addReason(none->message);
    failed = !result || result->status == SearchStatus::undecided;
    result ? writeSearch(*result, *search, model, sweep.tries_histories, row) : fail(row, result.errors());
    return true;
}

}  // namespace

double threadCpuSeconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::optional<ComputedRow> computeRun(const Sweep& sweep, const BatchInfo& info, std::uint64_t index,
                                      const std::atomic<bool>& stop) {
    const double begin = threadCpuSeconds();
    const SweepRun run = formats::runOf(sweep, index);
    RowWriter row(info);
    writeKeys(sweep, run, row);
    bool failed = true;
    try {
        const auto sampled = formats::scenarioOf(sweep, run);
        if (sampled) {
            writeDrawn(sweep, *sampled, row);
            row.addWarnings(sampled->scenario.warnings);
            if (!analyse(*sampled, sweep, stop, row, failed)) return std::nullopt;
        } else {
            fail(row, sampled.errors());
        }
    } catch (const std::exception& error) {  // memory, most likely; the other runs go on
        failed = true;
        fail(row, {Error{"", std::string("internal error: ") + error.what()}});
    }
    row.set("cpu_seconds", threadCpuSeconds() - begin);
    return ComputedRow{row.take(), failed};
}

}  // namespace talus::tools::batch
