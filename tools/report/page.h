#pragma once
// The page of a report: one JSON object inside the bundled page that draws it. README.md documents the
// object.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/json.h"
#include "report/figures.h"

namespace talus::tools {

/// The page without a report, as page/ makes it.
extern const std::string_view kReportPage;

/// The head of a report; sections are pushed to `sections`.
struct Report {
    std::string title, heading;
    Json opening = Json::array();   ///< blocks
    Json sections = Json::array();  ///< of section()
    Json provenance = Json::object();
};
Json toJson(const Report& report);

/// The self-contained page: nothing in the report can end its script element or become markup.
std::string reportPage(const Json& report);

// --- blocks
// ---------------------------------------------------------------------------------------------------------

Json section(const std::string& id, const std::string& nav, const std::string& title, Json blocks);
Json paragraph(const std::string& text, const std::string& style = "");  ///< style: lead, muted or alert
Json subheading(const std::string& text);
Json facts(const std::vector<std::pair<std::string, std::string>>& items);  ///< terms and what they are
Json file(const std::string& name, const std::string& text);                ///< folded up
Json drawings(const std::vector<Drawing>& items, bool pair, Json colours = Json::array());

/// The entries of `provenance`, as items of facts().
std::vector<std::pair<std::string, std::string>> provenanceFacts(const Json& provenance);

// --- tables
// ---------------------------------------------------------------------------------------------------------

enum ColumnLook : unsigned {
    kPlain = 0,
    kStart = 1,
    kStrong = 2,
    kSigned = 4
};  ///< kStart: a line before it

Json textColumn(const std::string& title, const std::string& group = "", unsigned look = kPlain);
Json numberColumn(const std::string& title, int decimals, const std::string& group = "",
                  unsigned look = kPlain);
Json valueColumn(const std::string& title,
                 const std::string& format = "");  ///< "figure": four digits; "share": percent

/// Rows of numbers, texts, nulls and {share, low, high}; one a column.
Json table(const std::string& caption, Json columns, Json rows);

Json maybe(std::optional<double> value);  ///< null for nothing

}  // namespace talus::tools
