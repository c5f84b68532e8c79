#include "verification/manual.h"

#include <algorithm>

#include "cli/json.h"
#include "cli/text.h"
#include "report/table.h"

namespace talus::tools {

namespace {

Json maybeNumber(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json rowJson(const VerifiedRow& row) {
    const VerificationRow& what = row.what;
    return {{"name", what.name},
            {"quantity", what.quantity},
            {"reference", number(what.reference)},
            {"source", what.source},
            {"kind", what.kind},
            {"value", maybeNumber(row.value)},
            {"difference", row.value ? number(row.difference()) : Json(nullptr)},
            {"low", maybeNumber(what.low)},
            {"high", maybeNumber(row.high)},
            {"ok", row.ok()},
            {"wall_seconds", number(row.computed->wall_seconds)},
            {"judged", what.judged()},
            {"as_stated", row.asStated()},
            {"why", what.why},
            {"status", row.computed->status},
            {"others", what.others},
            {"section", what.section},
            {"scenario", what.scenario},
            {"set", what.set}};
}

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(width, text.size() + 1), ' ');
    return text;
}

std::string figure(const std::optional<double>& value) {
    if (!value) return "none";
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.5g", *value);
    return buffer;
}

}  // namespace

std::size_t Manual::outside() const {
    return static_cast<std::size_t>(
        std::count_if(rows.begin(), rows.end(), [](const VerifiedRow& row) { return !row.ok(); }));
}

std::size_t Manual::unexpected() const {
    return static_cast<std::size_t>(
        std::count_if(rows.begin(), rows.end(), [](const VerifiedRow& row) { return !row.asStated(); }));
}

std::size_t Manual::judged() const {
    return static_cast<std::size_t>(
        std::count_if(rows.begin(), rows.end(), [](const VerifiedRow& row) { return row.what.judged(); }));
}

Json manualJson(const Manual& manual) {
    Json rows = Json::array();
    for (const VerifiedRow& row : manual.rows) rows.push_back(rowJson(row));
    return {{"rows", rows},
            {"judged", manual.judged()},
            {"outside", manual.outside()},
            {"unexpected", manual.unexpected()},
            {"quick", manual.quick},
            {"interrupted", manual.interrupted},
            {"wall_seconds", number(manual.wall_seconds)},
            {"provenance", manual.provenance}};
}

std::string manualCsv(const Manual& manual) {
    Table table;
    for (const VerifiedRow& row : manual.rows) {
        const Json json = rowJson(row);
        if (table.columns.empty())
            for (const auto& [key, value] : json.items()) table.columns.push_back(key);
        std::vector<Json> cells;
        for (const auto& [key, value] : json.items()) cells.push_back(value);
        table.rows.push_back(std::move(cells));
    }
    return table.csv();
}

std::string manualText(const Manual& manual) {
    std::string lines, section;
    for (const VerifiedRow& row : manual.rows) {
        if (section != row.what.section) lines += (section.empty() ? "" : "\n") + row.what.section + "\n";
        section = row.what.section;
        const std::string band =
            row.what.judged() ? "  [" + figure(row.what.low) + ", " + figure(row.high) + "]" : "  not judged";
        lines +=
            std::string(row.ok() ? "  " : "! ") + padded(row.what.name, 62) + padded(row.what.quantity, 20) +
            padded(figure(row.value), 10) + "reference " + padded(figure(row.what.reference), 9) + band +
            (row.value ? "" : "  " + row.computed->status) + (row.asStated() ? "" : "  unexpected") + "\n";
    }
    return lines + "\n" + std::to_string(manual.judged()) + " rows judged, " +
           std::to_string(manual.outside()) + " outside their bands, " + std::to_string(manual.unexpected()) +
           " not as the table states; " + text(manual.wall_seconds, 1) + " s" +
           (manual.interrupted ? "; interrupted, the others are missing" : "") + "\n";
}

}  // namespace talus::tools
