#include "batch/report.h"

#include <algorithm>
#include <cmath>

#include "batch/plots.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/provenance.h"
#include "cli/text.h"
#include "report/numbers.h"
#include "report/page.h"

namespace talus::tools::batch {

namespace {

constexpr std::size_t kFewValues = 30;      // of a column that is a grid
constexpr std::size_t kMostGrids = 4;       // heat maps are made of pairs of so many
constexpr std::size_t kMostResponses = 12;  // plots of single columns
constexpr std::size_t kFewestForShape = 5;  // answers, before a histogram says anything

/// An answer, or what stands for one beyond the search's ends.
Json answerJson(double value) {
    if (std::isfinite(value)) return value;
    return value > 0 ? Json("stands") : value < 0 ? Json("fails at start") : Json(nullptr);
}

Json shareJson(std::uint64_t hits, std::uint64_t count, const Interval& interval) {
    if (count == 0) return "not known";
    return {{"share", static_cast<double>(hits) / static_cast<double>(count)},
            {"low", interval.low},
            {"high", interval.high}};
}

/// Four digits that count, as the page shows them.
std::string figure(double value) {
    const double size = std::abs(value);
    const int decimals =
        size == 0 ? 2 : std::clamp(3 - static_cast<int>(std::floor(std::log10(size))), 0, 12);
    return typeset(text(value, decimals));
}

// --- sections
// --------------------------------------------------------------------------------------------------------

Json opening(const Summary& summary) {
    const BatchInfo& info = summary.info;
    Json blocks = Json::array(
        {paragraph(std::to_string(summary.done) + " of " + std::to_string(info.runs) +
                       " runs: " + info.analysis + " of " + info.scenario + ", " +
                       std::to_string(info.cases) + (info.cases == 1 ? " case, " : " cases, ") +
                       std::to_string(info.samples) + (info.samples == 1 ? " sample." : " samples each."),
                   "lead")});
    if (summary.done < info.runs)
        blocks.push_back(paragraph("Not finished: " + std::to_string(info.runs - summary.done) +
                                       " runs are missing. Run the same command again to continue.",
                                   "alert"));
    if (summary.beyond > 0)
        blocks.push_back(paragraph(rowsBeyond(summary.beyond, "results.csv") + ".", "alert"));
    if (summary.all.ranges > 0) {
        blocks.push_back(paragraph(
            "In " + std::to_string(summary.all.ranges) + (summary.all.ranges == 1 ? " run" : " runs") +
                " the answer depends on the loading path: use the lower end of the range.",
            "alert"));
    }
    if (summary.failed > 0)
        blocks.push_back(
            paragraph(std::to_string(summary.failed) +
                          " runs failed or are undecided; the figures below do not include them.",
                      "alert"));
    if (!summary.warnings.empty())
        blocks.push_back(paragraph("Runs have warnings, which are listed below.", "alert"));
    return blocks;
}

Json groupColumns(const BatchInfo& info, bool with_label) {
    Json columns = Json::array();
    if (with_label) columns.push_back(textColumn("case"));
    for (const char* title : {"runs", "decided"}) columns.push_back(numberColumn(title, 0));
    for (const char* title : {"mean", "standard deviation", "5 %", "median", "95 %"})
        columns.push_back(valueColumn(title, "figure"));
    for (const double threshold : info.thresholds)
        columns.push_back(valueColumn(thresholdText(info, threshold)));
    if (info.triesHistories()) {
        for (const double threshold : info.thresholds)
            columns.push_back(valueColumn(thresholdText(info, threshold) + ", lower end of the range"));
    }
    return columns;
}

Json groupRow(const Group& group, bool with_label) {
    Json row = Json::array();
    if (with_label) row.push_back(group.label);
    row.push_back(group.runs);
    row.push_back(group.decided);
    row.push_back(group.moments.count > 0 ? number(group.moments.mean) : Json(nullptr));
    row.push_back(group.moments.count > 1 ? number(group.moments.sd) : Json(nullptr));
    for (const double share : {0.05, 0.5, 0.95})
        row.push_back(group.sorted.empty() ? Json(nullptr) : answerJson(quantileOf(group.sorted, share)));
    for (const auto shares : {&Group::failure, &Group::failure_at_least}) {
        for (const FailureShare& share : group.*shares)
            row.push_back(shareJson(share.failed, share.count, share.interval));
    }
    return row;
}

std::string meanSentence(const Summary& summary) {
    const Moments& moments = summary.all.moments;
    if (moments.count == 0) return "No run found an answer.";
    std::string words = "Mean of the " + std::to_string(moments.count) + " answers " + figure(moments.mean);
    if (moments.count > 1)
        words += ", between " + figure(moments.mean_interval.low) + " and " +
                 figure(moments.mean_interval.high) + " with " + text(100 * summary.info.confidence, 0) +
                 " % confidence; standard deviation " + figure(moments.sd);
    return words + ".";
}

/// Without samples the runs are a design and not a random sample, so no confidence interval exists.
Json range(const Summary& summary) {
    const auto& sorted = summary.all.sorted;
    Json blocks = Json::array();
    if (sorted.empty()) return blocks;
    const auto words = [](double value) {
        const Json answer = answerJson(value);
        return answer.is_string() ? answer.get<std::string>() : figure(value);
    };
    blocks.push_back(paragraph("From " + words(sorted.front()) + " to " + words(sorted.back()) +
                               " over all cases, with a median of " + words(quantileOf(sorted, 0.5)) + "."));
    return blocks;
}

Json distribution(const Summary& summary) {
    const BatchInfo& info = summary.info;
    if (info.samples == 1)
        return section("distribution", "Answers", "The " + info.answerTitle(), range(summary));
    Json blocks{paragraph(meanSentence(summary)),
                table("All runs", groupColumns(info, false), Json::array({groupRow(summary.all, false)}))};
    if (!info.thresholds.empty())
        blocks.push_back(paragraph(
            "Probabilities of failure with their confidence intervals of " + text(100 * info.confidence, 0) +
                " % (Clopper and Pearson). Runs whose search did not reach the value in question "
                "are not "
                "counted." +
                (info.latin_hypercube
                     ? " The intervals are those of independent samples; a Latin hypercube has less scatter."
                     : ""),
            "muted"));
    if (summary.cases.size() > 1)
        blocks.push_back(paragraph("All cases together; each case is listed below.", "muted"));
    if (summary.all.moments.count >= kFewestForShape) {
        blocks.push_back(toJson(plotHistogram(summary)));
        blocks.push_back(toJson(plotDistribution(summary)));
    }
    return section("distribution", "Distribution", "Distribution of the " + info.answerTitle(),
                   std::move(blocks));
}

Json convergence(const Summary& summary) {
    Json blocks = Json::array();
    if (summary.info.samples > 1)
        for (std::size_t t = 0; t < summary.info.thresholds.size(); ++t)
            if (summary.all.failure[t].count >= kFewestForShape)
                blocks.push_back(toJson(plotConvergence(summary, t)));
    if (summary.info.samples > 1 && summary.all.moments.count > kFewestForShape)
        blocks.push_back(toJson(plotMeanConvergence(summary)));
    return section("convergence", "Convergence", "Convergence with the number of runs", std::move(blocks));
}

Json inputs(const Summary& summary) {
    Json blocks = Json::array();
    for (std::size_t v = 0; v < summary.value_columns.size() && blocks.size() <= kMostResponses; ++v) {
        const std::string& source = summary.info.columns[summary.value_columns[v]].source;
        if ((source != "random" && source != "interfaces") || valuesOf(summary, v).size() < kFewestForShape)
            continue;
        if (blocks.empty())
            blocks.push_back(
                paragraph("Values drawn in the runs with a result. For draws per interface: the mean, "
                          "smallest and largest value of each run."));
        blocks.push_back(toJson(plotInput(summary, v)));
    }
    return section("inputs", "Inputs", "Distribution of the inputs", std::move(blocks));
}

Json modes(const Summary& summary) {
    const bool sampled = summary.info.samples > 1;
    Json columns{textColumn("mode"), numberColumn("runs", 0), valueColumn("share", "share")},
        rows = Json::array();
    if (sampled) columns[2]["title"] = "share (confidence interval)";
    for (const auto& [mode, count] : summary.all.modes) {
        const Json share = shareJson(count, summary.all.decided,
                                     shareInterval(count, summary.all.decided, summary.info.confidence));
        rows.push_back({mode, count, sampled ? share : share["share"]});
    }
    Json blocks = Json::array();
    if (!rows.empty())
        blocks.push_back(table("Share of the decided runs", std::move(columns), std::move(rows)));
    return section("modes", "Failure modes", "Failure modes", std::move(blocks));
}

bool isGrid(const Summary& summary, std::size_t value) {
    const std::size_t count = valuesOf(summary, value).size();
    return summary.info.columns[summary.value_columns[value]].source == "grid" && count >= 2 &&
           count <= kFewValues;
}

Json heatMaps(const Summary& summary) {
    std::vector<std::size_t> grids;
    for (std::size_t v = 0; v < summary.value_columns.size() && grids.size() < kMostGrids; ++v)
        if (isGrid(summary, v)) grids.push_back(v);
    Json blocks = Json::array();
    for (std::size_t i = 0; i < grids.size(); ++i)
        for (std::size_t j = i + 1; j < grids.size(); ++j)
            blocks.push_back(toJson(plotHeatMap(summary, grids[i], grids[j])));
    return section("maps", "Heat maps", "Heat maps", std::move(blocks));
}

Json responses(const Summary& summary) {
    std::vector<std::size_t> order;
    for (const Sensitivity& one : summary.sensitivities) order.push_back(one.value);
    for (std::size_t v = 0; v < summary.value_columns.size(); ++v)
        if (std::find(order.begin(), order.end(), v) == order.end()) order.push_back(v);
    Json blocks = Json::array();
    for (const std::size_t v : order) {
        if (blocks.size() > kMostResponses || valuesOf(summary, v).size() < 2) continue;
        if (blocks.empty())
            blocks.push_back(
                paragraph("One dot is one run. If a column has few values, the line is the mean at each "
                          "value, and the band extends from the smallest to the largest answer."));
        blocks.push_back(toJson(plotResponse(summary, v)));
    }
    return section("response", "Response", "Response", std::move(blocks));
}

Json sensitivity(const Summary& summary) {
    Json blocks = Json::array();
    if (!summary.sensitivities.empty())
        blocks = {paragraph("Spearman\u2019s rank correlation of the answer with each column that varies, "
                            "and its confidence interval. Runs that fail at the start rank lowest. Runs that "
                            "are stable up to the largest load tried rank highest."),
                  toJson(plotCorrelations(summary))};
    return section("sensitivity", "Sensitivity", "Sensitivity", std::move(blocks));
}

/// One run per case: its answer, its mode, whether it has failed at the thresholds.
Json singleCases(const Summary& summary) {
    Json columns{textColumn("case"), valueColumn(summary.info.answerTitle(), "figure"),
                 textColumn("failure")};
    Json rows = Json::array();
    for (const double threshold : summary.info.thresholds)
        columns.push_back(valueColumn(thresholdText(summary.info, threshold)));
    for (const Group& group : summary.cases) {
        Json row{group.label, group.sorted.empty() ? Json(nullptr) : answerJson(group.sorted.front()),
                 group.modes.empty() ? "" : group.modes.begin()->first};
        for (const FailureShare& share : group.failure)
            row.push_back(share.count == 0 ? "not known" : share.failed > 0 ? "yes" : "no");
        rows.push_back(std::move(row));
    }
    return table("One run each", std::move(columns), std::move(rows));
}

Json cases(const Summary& summary) {
    Json blocks = Json::array();
    if (!summary.cases.empty() && summary.info.samples == 1) blocks.push_back(singleCases(summary));
    if (!summary.cases.empty() && summary.info.samples > 1) {
        Json rows = Json::array();
        for (const Group& group : summary.cases) rows.push_back(groupRow(group, true));
        blocks.push_back(
            table(summary.info.answerTitle(), groupColumns(summary.info, true), std::move(rows)));
    }
    return section("cases", "Cases", "Cases", std::move(blocks));
}

Json failures(const Summary& summary) {
    Json blocks = Json::array(), rows = Json::array();
    for (const auto& [run, reason] : summary.failures) rows.push_back({run, reason});
    if (!rows.empty())
        blocks.push_back(table(summary.failed > summary.failures.size() ? "The first of them" : "All of them",
                               {numberColumn("run", 0), textColumn("reason")}, std::move(rows)));
    return section("failures", "Failed runs", "Failed and undecided runs", std::move(blocks));
}

Json warnings(const Summary& summary) {
    Json blocks = Json::array(), rows = Json::array();
    const std::size_t shown = std::min(summary.warnings.size(), kMostWarningsShown);
    for (std::size_t k = 0; k < shown; ++k) {
        const WarningGroup& group = summary.warnings[k];
        rows.push_back({group.runs, group.first, group.text});
    }
    if (rows.empty()) return section("warnings", "Warnings", "Warnings", std::move(blocks));
    blocks.push_back(table(
        "Warnings that differ by numbers alone count as one; numbers are those of the first run",
        {numberColumn("runs", 0), numberColumn("first run", 0), textColumn("warning")}, std::move(rows)));
    if (const std::string more = moreWarnings(summary.warnings); !more.empty())
        blocks.push_back(paragraph(more + ".", "muted"));
    return section("warnings", "Warnings", "Warnings", std::move(blocks));
}

Json origin(const Summary& summary, const Json& provenance) {
    const BatchInfo& info = summary.info;
    std::vector<std::pair<std::string, std::string>> list{
        {"identity", info.identity},
        {"seed", std::to_string(info.seed)},
        {"sampling", info.latin_hypercube ? "Latin hypercube" : "random"}};
    for (auto& item : provenanceFacts(provenance)) list.push_back(std::move(item));
    return section("origin", "Origin", "Provenance",
                   {facts(list), file(info.sweep, info.sweep_text), file(info.scenario, info.scenario_text)});
}

}  // namespace

std::string rowsBeyond(std::uint64_t rows, const std::string& file) {
    return std::to_string(rows) + (rows == 1 ? " row" : " rows") + " of a batch with more samples " +
           (rows == 1 ? "stays" : "stay") + " in " + file + " and " + (rows == 1 ? "does" : "do") +
           " not count";
}

Json batchReport(const Summary& summary, const Json& provenance) {
    Report report;
    report.title = "Talus: batch of " + summary.info.sweep;
    report.heading = "Batch of " + summary.info.sweep;
    report.opening = opening(summary);
    report.provenance = provenance;
    std::vector<Json> sections{distribution(summary), convergence(summary), inputs(summary), modes(summary),
                               sensitivity(summary)};
    if (summary.all.moments.count > 0) {
        sections.push_back(heatMaps(summary));
        sections.push_back(responses(summary));
    }
    for (Json one : {cases(summary), failures(summary), warnings(summary), origin(summary, provenance)})
        sections.push_back(std::move(one));
    for (Json& one : sections)
        if (!one["blocks"].empty()) report.sections.push_back(std::move(one));
    return toJson(report);
}

Summary writeReport(const std::string& folder, const StoredBatch& batch, const Common& common) {
    Summary summary = summarise(batch);
    const Json facts = provenance(common, batch.info.scenario), report = batchReport(summary, facts);
    Json json = toJson(summary);
    json["provenance"] = facts;
    const auto write = [&](const char* name, const Json& what, int indent) {
        writeFile(folder + "/" + name, jsonText(what, indent) + "\n");
    };
    write(kSummaryName, json, 2);
    write(kReportName, report, -1);
    writeFile(folder + "/" + kPageName, reportPage(report));
    return summary;
}

}  // namespace talus::tools::batch
