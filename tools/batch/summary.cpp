#include "batch/summary.h"

#include <algorithm>
#include <cmath>

#include "cli/json.h"
#include "cli/text.h"

namespace talus::tools::batch {

namespace {

constexpr std::uint64_t kMostCases = 500;
constexpr std::size_t kMostFailures = 20;
constexpr double kShares[] = {0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95, 0.99};

/// NaN when the cell is empty.
double numberOf(const std::string& cell) { return numberIn(cell).value_or(std::nan("")); }

/// Reads one row's cells by the columns' names.
class RowReader {
 public:
    RowReader(const BatchInfo& info, const Row& row) : info_(info), row_(row) {}
    const std::string& text(const std::string& column) const {
        static const std::string empty;
        const auto index = info_.find(column);
        return index ? row_[*index] : empty;
    }
    double number(const std::string& column) const { return numberOf(text(column)); }

 private:
    const BatchInfo& info_;
    const Row& row_;
};

std::vector<std::size_t> numericVaried(const BatchInfo& info) {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < info.columns.size(); ++i) {
        const Column& column = info.columns[i];
        if (column.role == Column::Role::varied && (column.type == "number" || column.type == "integer"))
            indices.push_back(i);
    }
    return indices;
}

Observation observationOf(const Summary& summary, std::uint64_t run, const Row& row) {
    const BatchInfo& info = summary.info;
    const RowReader cells(info, row);
    Observation seen;
    seen.run = run;
    seen.case_index = run % info.cases;
    const std::string& status = cells.text("status");
    seen.answer = status == "unstable_at_start" ? -kInfinity
                  : status == "stable_to_stop"  ? kInfinity
                                                : cells.number(info.answerName());
    const double least = cells.number(info.keyInUnit(kRangeLow));
    seen.has_range = !std::isnan(least);
    seen.least = seen.has_range ? std::min(seen.answer, least) : seen.answer;
    seen.low = cells.number(info.keyInUnit("bracket_low"));
    seen.high = cells.number(info.keyInUnit("bracket_high"));
    seen.mode = cells.text("failure_mode");
    for (const std::size_t column : summary.value_columns) seen.values.push_back(numberOf(row[column]));
    return seen;
}

void addTo(Group& group, const Observation& seen) {
    ++group.decided;
    if (!std::isnan(seen.answer)) group.sorted.push_back(seen.answer);
    if (!seen.mode.empty()) ++group.modes[seen.mode];
    group.ranges += seen.has_range;
    const auto count = [&](std::vector<FailureShare>& shares, double answer) {
        for (FailureShare& share : shares) {
            const auto failed = hasFailed(seen, answer, share.threshold);
            share.count += failed.has_value();
            share.failed += failed.value_or(false);
        }
    };
    count(group.failure, seen.answer);
    count(group.failure_at_least, seen.least);
}

void finish(Group& group, double confidence) {
    std::sort(group.sorted.begin(), group.sorted.end());
    std::vector<double> finite;
    for (const double answer : group.sorted)
        if (std::isfinite(answer)) finite.push_back(answer);
    group.moments = momentsOf(finite, confidence);
    for (auto shares : {&Group::failure, &Group::failure_at_least}) {
        for (FailureShare& share : group.*shares)
            share.interval = shareInterval(share.failed, share.count, confidence);
    }
}

Group emptyGroup(const BatchInfo& info, std::string label, std::optional<std::uint64_t> case_index,
                 std::uint64_t runs) {
    Group group;
    group.label = std::move(label);
    group.case_index = case_index;
    group.runs = runs;
    for (const double threshold : info.thresholds) group.failure.push_back({threshold, 0, 0, {0, 1}});
    if (info.triesHistories()) group.failure_at_least = group.failure;
    return group;
}

void addSensitivities(Summary& summary) {
    std::vector<double> answers;
    std::vector<const Observation*> told;
    for (const Observation& seen : summary.observations)
        if (!std::isnan(seen.answer)) told.push_back(&seen);
    for (std::size_t v = 0; v < summary.value_columns.size(); ++v) {
        std::vector<double> x, y;
        for (const Observation* seen : told) {
            if (std::isnan(seen->values[v])) continue;
            x.push_back(seen->values[v]);
            y.push_back(seen->answer);
        }
        const Correlation found = rankCorrelation(x, y, summary.info.confidence);
        if (found.known)
            summary.sensitivities.push_back({summary.info.columns[summary.value_columns[v]].name, v, found});
    }
    std::stable_sort(summary.sensitivities.begin(), summary.sensitivities.end(),
                     [](const Sensitivity& a, const Sensitivity& b) {
                         return std::abs(a.correlation.rho) > std::abs(b.correlation.rho);
                     });
}

// --- JSON
// -----------------------------------------------------------------------------------------------------------

Json toJson(const Interval& interval) { return Json::array({number(interval.low), number(interval.high)}); }

Json quantilesJson(const Group& group) {
    Json quantiles = Json::object();
    if (group.sorted.empty()) return quantiles;
    for (const double share : kShares) quantiles[csvNumber(share)] = number(quantileOf(group.sorted, share));
    return quantiles;
}

Json toJson(const std::vector<FailureShare>& shares) {
    Json failure = Json::array();
    for (const FailureShare& share : shares) {
        failure.push_back({{"at", share.threshold},
                           {"failed", share.failed},
                           {"of", share.count},
                           {"probability", share.count ? number(static_cast<double>(share.failed) /
                                                                static_cast<double>(share.count))
                                                       : Json(nullptr)},
                           {"interval", toJson(share.interval)}});
    }
    return failure;
}

Json toJson(const Group& group, const BatchInfo& info) {
    Json modes = Json::object();
    for (const auto& [mode, count] : group.modes) modes[mode] = count;
    Json json{{"runs", group.runs}, {"decided", group.decided}};
    if (group.case_index) json["case"] = *group.case_index;
    if (!group.label.empty()) json["label"] = group.label;
    const bool any = group.moments.count > 0;
    json["answers"] = group.moments.count;
    json["mean"] = any ? number(group.moments.mean) : Json(nullptr);
    json["sd"] = any ? number(group.moments.sd) : Json(nullptr);
    json["mean_interval"] = any ? toJson(group.moments.mean_interval) : Json(nullptr);
    json["quantiles"] = quantilesJson(group);
    json["failure"] = toJson(group.failure);
    if (info.triesHistories()) {
        json["ranges"] = group.ranges;
        json["failure_at_range_low"] = toJson(group.failure_at_least);
    }
    json["modes"] = modes;
    return json;
}

}  // namespace

Json toJson(const std::vector<WarningGroup>& warnings) {
    Json list = Json::array();
    for (const WarningGroup& group : warnings)
        list.push_back({{"text", group.text},
                        {"runs", group.runs},
                        {"first_run", group.first},
                        {"numbers_differ", group.differs}});
    return list;
}

std::optional<bool> hasFailed(const Observation& seen, double answer, double threshold) {
    if (std::isfinite(answer)) return answer <= threshold;
    if (answer < 0) return seen.high <= threshold ? std::optional(true) : std::nullopt;
    return seen.low >= threshold ? std::optional(false) : std::nullopt;
}

std::string caseLabel(const BatchInfo& info, const Row& row) {
    std::string label;
    for (std::size_t i = 0; i < info.columns.size(); ++i) {
        const Column& column = info.columns[i];
        if (column.name == "name" && column.role == Column::Role::key) return row[i];
        if (column.role != Column::Role::varied || (column.source != "grid" && column.source != "table"))
            continue;
        label += (label.empty() ? "" : ", ") + column.name + " = " + row[i];
    }
    return label;
}

Summary summarise(const StoredBatch& batch) {
    Summary summary;
    summary.info = batch.info;
    summary.beyond = batch.beyond;
    const BatchInfo& info = summary.info;
    summary.value_columns = numericVaried(info);
    summary.all = emptyGroup(info, "", std::nullopt, info.runs);
    const bool lists_cases = info.cases > 1 && info.cases <= kMostCases;
    std::map<std::uint64_t, Group> cases;
    std::vector<std::uint64_t> runs;
    for (const auto& entry : batch.lines) runs.push_back(entry.first);
    std::sort(runs.begin(), runs.end());
    const std::size_t status = *info.find("status");
    const auto warned = info.find(kWarnings);  // earlier versions had them in the column reason
    WarningCount warnings;
    for (const std::uint64_t run : runs) {
        const Row row = batch.row(run);
        ++summary.done;
        ++summary.statuses[row[status]];
        if (warned) warnings.add(run, row[*warned]);
        if (isFailure(row[status])) {
            ++summary.failed;
            if (summary.failures.size() < kMostFailures)
                summary.failures.emplace_back(run, row[status] + ": " + row.back());
            continue;
        }
        summary.observations.push_back(observationOf(summary, run, row));
        const Observation& seen = summary.observations.back();
        addTo(summary.all, seen);
        if (!lists_cases) continue;
        const auto [place, is_new] = cases.try_emplace(seen.case_index);
        if (is_new) place->second = emptyGroup(info, caseLabel(info, row), seen.case_index, info.samples);
        addTo(place->second, seen);
    }
    finish(summary.all, info.confidence);
    for (auto& [index, group] : cases) {
        finish(group, info.confidence);
        summary.cases.push_back(std::move(group));
    }
    addSensitivities(summary);
    summary.warnings = warnings.groups();
    return summary;
}

Json toJson(const Summary& summary) {
    const BatchInfo& info = summary.info;
    Json cases = Json::array(), sensitivities = Json::array(), failures = Json::array();
    Json statuses = Json::object();
    for (const Group& group : summary.cases) cases.push_back(toJson(group, info));
    for (const Sensitivity& one : summary.sensitivities)
        sensitivities.push_back({{"column", one.column},
                                 {"rank_correlation", number(one.correlation.rho)},
                                 {"interval", toJson(one.correlation.interval)}});
    for (const auto& [run, reason] : summary.failures) failures.push_back({{"run", run}, {"reason", reason}});
    for (const auto& [status, count] : summary.statuses) statuses[status] = count;
    return {{"runs", info.runs},
            {"done", summary.done},
            {"rows_beyond", summary.beyond},
            {"failed", summary.failed},
            {"analysis", info.analysis},
            {"answer", info.answerName()},
            {"confidence", info.confidence},
            {"cases", info.cases},
            {"samples", info.samples},
            {"seed", info.seed},
            {"sampling", info.latin_hypercube ? "latin-hypercube" : "random"},
            {"identity", info.identity},
            {"statuses", statuses},
            {"all", toJson(summary.all, info)},
            {"by_case", cases},
            {"sensitivity", sensitivities},
            {"failures", failures},
            {"warnings", toJson(summary.warnings)}};
}

}  // namespace talus::tools::batch
