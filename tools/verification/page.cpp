// The page of the verification manual.

#include <algorithm>
#include <map>
#include <set>

#include "cli/json.h"
#include "cli/text.h"
#include "report/page.h"
#include "verification/manual.h"

namespace talus::tools {

namespace {

constexpr std::size_t kMostText = 20'000;  // of a scenario that is shown on the page [bytes]

Json cell(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

std::string bandText(const VerifiedRow& row) {
    if (!row.what.judged()) return "not judged";
    const auto figure = [](const std::optional<double>& value) {
        if (!value) return std::string("?");
        char buffer[32];
        std::snprintf(buffer, sizeof buffer, "%.5g", *value);
        return std::string(buffer);
    };
    return figure(row.what.low) + " to " + figure(row.high);
}

std::string kindText(std::string kind) {
    std::replace(kind.begin(), kind.end(), '_', ' ');
    return kind;
}

std::string verdict(const VerifiedRow& row) {
    if (!row.what.judged()) return "reported";
    if (!row.value) return "no value: " + row.computed->status;
    if (row.ok()) return row.asStated() ? "inside" : "inside, and stated to be outside";
    return row.asStated() ? "outside, as stated" : "outside";
}

Json rowCells(const VerifiedRow& row) {
    return Json::array({row.what.name, row.what.quantity, kindText(row.what.kind), number(row.what.reference),
                        bandText(row), cell(row.value), row.value ? number(row.difference()) : Json(nullptr),
                        number(row.computed->wall_seconds), verdict(row),
                        row.what.source + (row.what.others.empty() ? "" : "; " + row.what.others) +
                            (row.what.why.empty() ? "" : ". Outside: " + row.what.why)});
}

Json rowTable(const std::vector<const VerifiedRow*>& rows, const std::string& caption) {
    const Json columns{textColumn("problem"),
                       textColumn("quantity"),
                       textColumn("reference is a", "", kStart),
                       valueColumn("reference", "figure"),
                       textColumn("band"),
                       Json{{"title", "computed"}, {"format", "figure"}, {"start", true}, {"strong", true}},
                       valueColumn("difference", "figure"),
                       numberColumn("time [s]", 2),
                       textColumn("verdict", "", kStart),
                       textColumn("source of the reference; what others gave; why it is outside")};
    Json cells = Json::array(), alerts = Json::array();
    for (std::size_t k = 0; k < rows.size(); ++k) {
        cells.push_back(rowCells(*rows[k]));
        if (!rows[k]->ok()) alerts.push_back(k);
    }
    Json json = table(caption, columns, cells);
    json["alerts"] = alerts;
    return json;
}

/// Pictures of the scenarios of these rows, each once.
Json pictures(const std::vector<const VerifiedRow*>& rows) {
    Json items = Json::array();
    std::set<std::string> seen;
    for (const VerifiedRow* row : rows)
        if (seen.insert(scenarioName(row->what)).second) items.push_back(problemPicture(*row));
    Json colours = Json::array();
    for (const auto& [role, words] : {std::pair{"stable", "stays"},
                                      {"sliding", "slides"},
                                      {"mixed", "slides and turns"},
                                      {"toppling", "topples"},
                                      {"fixed", "fixed"}})
        colours.push_back({{"role", role}, {"text", words}});
    return {{"type", "drawings"}, {"items", items}, {"colours", colours}};
}

Json scenarioFiles(const Manual& manual) {
    Json blocks =
        Json::array({paragraph("Each file is also in scenarios/ beside this page. It is recomputed by the "
                               "command at its top, or by \u201ctalus critical-angle FILE\u201d, \u201ctalus "
                               "safety-factor FILE\u201d and similar commands.")});
    std::set<std::string> seen;
    for (const VerifiedRow& row : manual.rows)
        if (const std::string text = scenarioText(row.what);
            seen.insert(scenarioName(row.what)).second && text.size() <= kMostText)
            blocks.push_back(file(scenarioName(row.what) + ".toml", text));
    return section("scenarios", "Scenarios", "Scenario files", std::move(blocks));
}

std::string countText(const Manual& manual) {
    std::string text = std::to_string(manual.judged()) + " rows are held to a band, " +
                       std::to_string(manual.outside()) + " of them are outside";
    if (manual.outside() == 0) return text + ".";
    if (manual.unexpected() == 0) return text + ", all of them known; the reason is given for each.";
    return text + "; " + std::to_string(manual.unexpected()) + " rows are not as the table states.";
}

/// How many references are of which kind.
std::string kindsText(const Manual& manual) {
    std::map<std::string, int> counts;
    for (const VerifiedRow& row : manual.rows) ++counts[row.what.kind];
    return std::to_string(counts["closed_form"]) + " references are closed forms, " +
           std::to_string(counts["published"]) + " are values that other programs or authors published, " +
           std::to_string(counts["laboratory"]) + " were measured in a laboratory, " +
           std::to_string(counts["bound"]) +
           " are bounds. References that are not closed forms are held to a range.";
}

Json opening(const Manual& manual) {
    Json blocks = Json::array({paragraph(countText(manual), "lead"), paragraph(kindsText(manual))});
    if (manual.interrupted)
        blocks.push_back(paragraph("Interrupted: only the rows computed before that are shown.", "alert"));
    if (manual.quick) blocks.push_back(paragraph("Only the rows that take seconds (--quick).", "muted"));
    blocks.push_back(paragraph(
        "Unless stated otherwise, a closed form must be met within 0.02\u00b0 beyond the bracket of a "
        "search, or within 0.1 %. A bound must not be exceeded. A laboratory's or another program's value is "
        "one of several, and its band covers them. Rows that are not judged are given for comparison."));
    return blocks;
}

/// Rows outside their bands: by how much, and why.
Json outsideTable(const std::vector<const VerifiedRow*>& rows, const std::string& caption) {
    Json cells = Json::array(), alerts = Json::array();
    for (const VerifiedRow* row : rows) {
        alerts.push_back(cells.size());
        const std::string why = row->asStated() ? row->what.why : "not known: " + verdict(*row);
        cells.push_back(Json::array({row->what.name, bandText(*row), cell(row->value), why}));
    }
    const Json columns{textColumn("problem"), textColumn("band"),
                       Json{{"title", "computed"}, {"format", "figure"}, {"start", true}, {"strong", true}},
                       textColumn("why")};
    Json json = table(caption, columns, cells);
    json["alerts"] = alerts;
    return json;
}

Json outsideSection(const Manual& manual) {
    std::vector<const VerifiedRow*> outside;
    for (const VerifiedRow& row : manual.rows)
        if (!row.asStated() || !row.ok()) outside.push_back(&row);
    return section("outside", "Outside", "Outside their bands",
                   {outsideTable(outside, "Rows that are outside their bands, or not as the table states")});
}

}  // namespace

Json manualReport(const Manual& manual) {
    Report report;
    report.title = "Talus: verification manual";
    report.heading = "Verification manual";
    report.opening = opening(manual);
    report.provenance = manual.provenance;
    if (manual.outside() + manual.unexpected() > 0) report.sections.push_back(outsideSection(manual));
    for (auto row = manual.rows.begin(); row != manual.rows.end();) {
        const std::string name = row->what.section;
        std::vector<const VerifiedRow*> rows;
        for (; row != manual.rows.end() && row->what.section == name; ++row) rows.push_back(&*row);
        report.sections.push_back(section("section-" + std::to_string(report.sections.size()), name, name,
                                          {rowTable(rows, name), pictures(rows)}));
    }
    report.sections.push_back(scenarioFiles(manual));
    return toJson(report);
}

}  // namespace talus::tools
