#include "report/page.h"

#include <algorithm>

#include "cli/json.h"

namespace talus::tools {
namespace {

constexpr std::string_view kPlace = "<!--REPORT-->";

Json column(const std::string& title, const std::string& group, unsigned look) {
    Json json{{"title", title}};
    if (!group.empty()) json["group"] = group;
    if (look & kStart) json["start"] = true;
    if (look & kStrong) json["strong"] = true;
    if (look & kSigned) json["signed"] = true;
    return json;
}

}  // namespace

Json toJson(const Report& report) {
    return {{"format", 1},
            {"title", report.title},
            {"heading", report.heading},
            {"opening", report.opening},
            {"sections", report.sections},
            {"provenance", report.provenance}};
}

std::string reportPage(const Json& report) {
    std::string data;
    // Inside a script element only < can do harm ("</script>", "<!--"); in JSON it stands in strings alone.
    for (const char letter : jsonText(report))
        data += letter == '<' ? std::string("\\u003c") : std::string(1, letter);
    const std::size_t place = kReportPage.find(kPlace);
    return std::string(kReportPage.substr(0, place)) + "<script id=\"report\" type=\"application/json\">" +
           data + "</script>" + std::string(kReportPage.substr(place + kPlace.size()));
}

Json section(const std::string& id, const std::string& nav, const std::string& title, Json blocks) {
    return {{"id", id}, {"nav", nav}, {"title", title}, {"blocks", std::move(blocks)}};
}

Json paragraph(const std::string& text, const std::string& style) {
    Json json{{"type", "text"}, {"text", text}};
    if (!style.empty()) json["style"] = style;
    return json;
}

Json subheading(const std::string& text) { return {{"type", "heading"}, {"text", text}}; }

Json facts(const std::vector<std::pair<std::string, std::string>>& items) {
    Json list = Json::array();
    for (const auto& [term, value] : items) list.push_back(Json::array({term, value}));
    return {{"type", "facts"}, {"items", list}};
}

Json file(const std::string& name, const std::string& text) {
    return {{"type", "file"}, {"name", name}, {"text", text}};
}

Json drawings(const std::vector<Drawing>& items, bool pair, Json colours) {
    Json list = Json::array();
    for (const Drawing& drawing : items) list.push_back(toJson(drawing));
    Json json{{"type", "drawings"}, {"items", list}};
    if (pair) json["pair"] = true;
    if (!colours.empty()) json["colours"] = std::move(colours);
    return json;
}

std::vector<std::pair<std::string, std::string>> provenanceFacts(const Json& provenance) {
    std::vector<std::pair<std::string, std::string>> items;
    for (const auto& [key, value] : provenance.items()) {
        if (value.is_null()) continue;
        std::string term = key;
        std::replace(term.begin(), term.end(), '_', ' ');
        items.emplace_back(term, value.is_string() ? value.get<std::string>() : jsonText(value));
    }
    return items;
}

Json textColumn(const std::string& title, const std::string& group, unsigned look) {
    Json json = column(title, group, look);
    json["format"] = "text";
    return json;
}

Json numberColumn(const std::string& title, int decimals, const std::string& group, unsigned look) {
    Json json = column(title, group, look);
    json["decimals"] = decimals;
    return json;
}

Json valueColumn(const std::string& title, const std::string& format) {
    Json json = column(title, "", kPlain);
    if (!format.empty()) json["format"] = format;
    return json;
}

Json table(const std::string& caption, Json columns, Json rows) {
    return {
        {"type", "table"}, {"caption", caption}, {"columns", std::move(columns)}, {"rows", std::move(rows)}};
}

Json maybe(std::optional<double> value) { return value ? number(*value) : Json(nullptr); }

}  // namespace talus::tools
