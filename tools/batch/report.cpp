#include "batch/report.h"

#include <algorithm>
#include <cmath>

#include "batch/plots.h"
#include "report/html.h"
#include "report/page_style.h"

namespace talus::tools::batch {

namespace {

using namespace html;

constexpr std::size_t kFewValues = 30;      // of a column that is a grid
constexpr std::size_t kMostResponses = 12;  // plots of single columns
constexpr std::size_t kFewestForShape = 5;  // answers, before a histogram says anything

std::string percent(double share) { return text(100 * share, share > 0 && share < 0.1 ? 2 : 1) + " %"; }

std::string shareText(const FailureShare& share) {
    if (share.count == 0) return "not known";
    return percent(static_cast<double>(share.failed) / static_cast<double>(share.count)) + " (" +
           percent(share.interval.low) + " to " + percent(share.interval.high) + ")";
}

std::string thresholdTitle(const BatchInfo& info, double threshold) {
    return std::string(info.search() ? info.search()->answer : "") + " below " + csvNumber(threshold) +
           info.unitSymbol();
}

/// Four digits that count.
std::string figure(double value) {
    if (!std::isfinite(value)) return value > 0 ? "stands" : value < 0 ? "fails at start" : "\u2013";
    const double size = std::abs(value);
    const int decimals =
        size == 0 ? 2 : std::clamp(3 - static_cast<int>(std::floor(std::log10(size))), 0, 12);
    return typeset(text(value, decimals));
}

// --- sections --------------------------------------------------------------------------------------------------------

std::string opening(const Summary& summary) {
    const BatchInfo& info = summary.info;
    std::string words = std::to_string(summary.done) + " of " + std::to_string(info.runs) +
                        " runs: " + info.analysis + " of " + info.scenario + ", " +
                        std::to_string(info.cases) + (info.cases == 1 ? " case, " : " cases, ") +
                        std::to_string(info.samples) + (info.samples == 1 ? " sample." : " samples each.");
    std::string page = tagged("h1", "Batch of " + escaped(info.sweep)) + paragraph(words, "lead");
    if (summary.done < info.runs)
        page += paragraph("Not finished: " + std::to_string(info.runs - summary.done) +
                              " runs are missing. The same command goes on where it was stopped.",
                          "alert");
    if (summary.failed > 0)
        page += paragraph(std::to_string(summary.failed) +
                              " runs failed or ended undecided; they are left out of the figures below.",
                          "alert");
    return page;
}

std::string groupHead(const BatchInfo& info, bool with_label) {
    std::string cells = (with_label ? head("case", "words") : "") + head("runs") + head("decided") +
                        head("mean") + head("standard deviation") + head("5 %") + head("median") +
                        head("95 %");
    for (const double threshold : info.thresholds) cells += head(thresholdTitle(info, threshold));
    return row(cells);
}

std::string groupRow(const Group& group, bool with_label) {
    const bool any = group.moments.count > 0, many = group.moments.count > 1;
    std::string cells = with_label ? cell(group.label, "words") : "";
    cells += cell(std::to_string(group.runs)) + cell(std::to_string(group.decided));
    cells +=
        cell(any ? figure(group.moments.mean) : "\u2013") + cell(many ? figure(group.moments.sd) : "\u2013");
    for (const double share : {0.05, 0.5, 0.95})
        cells += cell(group.sorted.empty() ? "\u2013" : figure(quantileOf(group.sorted, share)));
    for (const FailureShare& share : group.failure) cells += cell(shareText(share));
    return row(cells);
}

std::string meanSentence(const Summary& summary) {
    const Moments& moments = summary.all.moments;
    if (moments.count == 0) return paragraph("No run has found an answer.");
    std::string words = "Mean of the " + std::to_string(moments.count) + " answers " + figure(moments.mean);
    if (moments.count > 1)
        words += ", between " + figure(moments.mean_interval.low) + " and " +
                 figure(moments.mean_interval.high) + " with " + text(100 * summary.info.confidence, 0) +
                 " % confidence; standard deviation " + figure(moments.sd);
    return paragraph(words + ".");
}

/// Without samples the runs are a design, not a sample of anything: there is no confidence to speak of.
std::string range(const Summary& summary) {
    if (summary.all.sorted.empty()) return "";
    return paragraph("From " + figure(summary.all.sorted.front()) + " to " +
                     figure(summary.all.sorted.back()) + " over all cases, in the middle " +
                     figure(quantileOf(summary.all.sorted, 0.5)) + ".");
}

std::string distribution(const Summary& summary) {
    if (summary.info.samples == 1)
        return heading("distribution", "The " + summary.info.answerTitle()) + range(summary);
    std::string page = heading("distribution", "Distribution of the " + summary.info.answerTitle()) +
                       meanSentence(summary) +
                       table("All runs", groupHead(summary.info, false), groupRow(summary.all, false));
    if (!summary.info.thresholds.empty())
        page += paragraph(
            "Probabilities of failure with their confidence intervals of " +
                text(100 * summary.info.confidence, 0) +
                " % (Clopper and Pearson). Runs whose search did not reach the value in question "
                "are not "
                "counted." +
                (summary.info.latin_hypercube
                     ? " The intervals are those of independent samples; a Latin hypercube scatters less."
                     : ""),
            "muted");
    if (summary.cases.size() > 1)
        page += paragraph("All cases together; each for itself further below.", "muted");
    if (summary.all.moments.count >= kFewestForShape)
        page += wide(plotHistogram(summary).inlined()) + wide(plotDistribution(summary).inlined());
    return page;
}

std::string modes(const Summary& summary) {
    if (summary.all.modes.empty()) return "";
    const bool sampled = summary.info.samples > 1;
    std::string rows;
    for (const auto& [mode, count] : summary.all.modes) {
        const Interval interval = shareInterval(count, summary.all.decided, summary.info.confidence);
        rows += row(cell(mode, "words") + cell(std::to_string(count)) +
                    cell(percent(static_cast<double>(count) / static_cast<double>(summary.all.decided))) +
                    (sampled ? cell(percent(interval.low) + " to " + percent(interval.high)) : ""));
    }
    return heading("modes", "Failure modes") +
           table("Share of the decided runs",
                 row(head("mode", "words") + head("runs") + head("share") +
                     (sampled ? head("confidence interval") : "")),
                 rows);
}

bool isGrid(const Summary& summary, std::size_t value) {
    const std::size_t count = valuesOf(summary, value).size();
    return count >= 2 && count <= kFewValues;
}

std::string heatMaps(const Summary& summary) {
    std::vector<std::size_t> grids;
    for (std::size_t v = 0; v < summary.value_columns.size(); ++v)
        if (summary.info.columns[summary.value_columns[v]].source == "grid" && isGrid(summary, v))
            grids.push_back(v);
    std::string page;
    for (std::size_t i = 0; i < std::min<std::size_t>(grids.size(), 4); ++i)
        for (std::size_t j = i + 1; j < std::min<std::size_t>(grids.size(), 4); ++j)
            page += wide(plotHeatMap(summary, grids[i], grids[j]).inlined());
    return page.empty() ? "" : heading("maps", "Heat maps") + page;
}

std::string responses(const Summary& summary) {
    std::vector<std::size_t> order;
    for (const Sensitivity& one : summary.sensitivities) order.push_back(one.value);
    for (std::size_t v = 0; v < summary.value_columns.size(); ++v)
        if (std::find(order.begin(), order.end(), v) == order.end()) order.push_back(v);
    std::string page;
    std::size_t plots = 0;
    for (const std::size_t v : order) {
        if (plots == kMostResponses) break;
        if (valuesOf(summary, v).size() < 2) continue;
        page += wide(plotResponse(summary, v).inlined());
        ++plots;
    }
    if (page.empty()) return "";
    return heading("response", "Response") +
           paragraph(
               "One dot is one run; where a column has few values, the line is the mean at each of them and "
               "the "
               "band the range from the smallest to the largest.") +
           page;
}

std::string sensitivity(const Summary& summary) {
    if (summary.sensitivities.empty()) return "";
    return heading("sensitivity", "Sensitivity") +
           paragraph(
               "Spearman's rank correlation of the answer with what varies, and its confidence interval. "
               "Runs that "
               "fail at the start rank lowest, those that stand to the end highest.") +
           wide(plotTornado(summary).inlined());
}

/// One run per case: its answer, its mode, whether it has failed at the thresholds.
std::string singleRow(const Group& group) {
    std::string cells = cell(group.label, "words") +
                        cell(group.sorted.empty() ? "\u2013" : figure(group.sorted.front())) +
                        cell(group.modes.empty() ? "" : group.modes.begin()->first, "words");
    for (const FailureShare& share : group.failure)
        cells += cell(share.count == 0 ? "not known" : share.failed > 0 ? "yes" : "no");
    return row(cells);
}

std::string singleCases(const Summary& summary) {
    std::string cells = head("case", "words") + head(summary.info.answerTitle()) + head("failure", "words"),
                rows;
    for (const double threshold : summary.info.thresholds)
        cells += head(thresholdTitle(summary.info, threshold));
    for (const Group& group : summary.cases) rows += singleRow(group);
    return heading("cases", "Cases") + table("One run each", row(cells), rows);
}

std::string cases(const Summary& summary) {
    if (summary.cases.empty()) return "";
    if (summary.info.samples == 1) return singleCases(summary);
    std::string rows;
    for (const Group& group : summary.cases) rows += groupRow(group, true);
    return heading("cases", "Cases") + table(summary.info.answerTitle(), groupHead(summary.info, true), rows);
}

std::string failures(const Summary& summary) {
    if (summary.failures.empty()) return "";
    std::string rows;
    for (const auto& [run, reason] : summary.failures)
        rows += row(cell(std::to_string(run)) + cell(reason, "words"));
    return heading("failures", "Failed and undecided runs") +
           table(summary.failed > summary.failures.size() ? "The first of them" : "All of them",
                 row(head("run") + head("reason", "words")), rows);
}

std::string origin(const Summary& summary, const Json& provenance) {
    const BatchInfo& info = summary.info;
    std::string list = definition("identity", info.identity) + definition("seed", std::to_string(info.seed)) +
                       definition("sampling", info.latin_hypercube ? "Latin hypercube" : "random");
    for (const auto& [key, value] : provenance.items()) {
        if (value.is_null()) continue;
        std::string term = key;
        std::replace(term.begin(), term.end(), '_', ' ');
        list += definition(term, value.is_string() ? value.get<std::string>() : value.dump());
    }
    const auto file = [](const std::string& name, const std::string& content) {
        return tagged("details", tagged("summary", escaped(name)) + tagged("pre", escaped(content)));
    };
    return heading("origin", "Where this comes from") + tagged("dl", list) +
           file(info.sweep, info.sweep_text) + file(info.scenario, info.scenario_text);
}

std::string style() {
    const auto more = [](const Palette& palette) {
        return "svg .bar{fill:" + palette.water + ";stroke:" + palette.page +
               ";stroke-width:1}\nsvg .dot{fill:" + palette.dem + ";fill-opacity:.55}\n";
    };
    return "<style>" + std::string(kPageStyle) + "td.words{white-space:normal;min-width:12rem}\n" +
           drawingStyle(lightPalette(), "svg ") + more(lightPalette()) + heatStyle("svg ") +
           "@media screen and (prefers-color-scheme:dark){\n" + drawingStyle(darkPalette(), "svg ") +
           more(darkPalette()) + "}\n</style>\n";
}

}  // namespace

std::string batchPage(const Summary& summary, const Json& provenance) {
    const bool any = summary.all.moments.count > 0;
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
           "content=\"width=device-width, initial-scale=1\">\n<meta name=\"color-scheme\" content=\"light "
           "dark\">\n<title>Talus: batch of " +
           escaped(summary.info.sweep) + "</title>\n" + style() + "</head>\n<body>\n" +
           tagged("header", opening(summary)) + "<main>\n" + distribution(summary) + modes(summary) +
           sensitivity(summary) + (any ? heatMaps(summary) + responses(summary) : "") + cases(summary) +
           failures(summary) + origin(summary, provenance) + "</main>\n</body>\n</html>\n";
}

void writeReport(const std::string& folder, const StoredBatch& batch, const Common& common) {
    const Summary summary = summarise(batch);
    const Json facts = provenance(common, batch.info.scenario);
    Json json = toJson(summary);
    json["provenance"] = facts;
    writeFile(folder + "/summary.json", json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    writeFile(folder + "/report.html", batchPage(summary, facts));
}

}  // namespace talus::tools::batch
