#include "verification/rows.h"

#include <algorithm>
#include <array>

#include "cli/failures.h"
#include "example_scenarios.h"
#include "paper_scenarios.h"
#include "report/csv.h"
#include "reproduction/scenario_text.h"
#include "verification_scenarios.h"

namespace talus::tools {

namespace {

constexpr std::string_view kTable = "bench/verification/rows.csv";
constexpr std::array<std::string_view, 14> kColumns{"section",   "name",   "scenario", "set",  "quantity",
                                                    "reference", "low",    "high",     "kind", "seconds",
                                                    "source",    "others", "found",    "why"};
constexpr std::array<std::string_view, 4> kKinds{"closed_form", "published", "laboratory", "bound"};
constexpr std::string_view kCeiling = "ceiling";

/// Fields of one line, by the column's name.
class Fields {
 public:
    Fields(std::string_view line, std::string path, int number)
        : fields_(csvFields(line)), path_(std::move(path)), number_(number) {
        if (fields_.size() != kColumns.size())
            fail("", "found " + std::to_string(fields_.size()) +
                         " columns, allowed: " + std::to_string(kColumns.size()));
    }

    const std::string& text(std::string_view column) const {
        return fields_[static_cast<std::size_t>(std::find(kColumns.begin(), kColumns.end(), column) -
                                                kColumns.begin())];
    }
    double number(std::string_view column) const {
        const auto value = numberIn(text(column));
        if (!value) fail(column, "found \"" + text(column) + "\", allowed: a number");
        return *value;
    }
    std::optional<double> maybe(std::string_view column) const {
        if (text(column).empty()) return std::nullopt;
        return number(column);
    }
    [[noreturn]] void fail(std::string_view column, const std::string& message) const {
        throw BadInput(Error{std::string(column), message, path_, number_, 1});
    }

 private:
    std::vector<std::string> fields_;
    std::string path_;
    int number_;
};

VerificationRow rowOf(const Fields& fields) {
    VerificationRow row{.section = fields.text("section"),
                        .name = fields.text("name"),
                        .scenario = fields.text("scenario"),
                        .set = fields.text("set"),
                        .quantity = fields.text("quantity"),
                        .reference = fields.number("reference"),
                        .low = fields.maybe("low"),
                        .high = std::nullopt,
                        .ceiling_is_high = fields.text("high") == kCeiling,
                        .kind = fields.text("kind"),
                        .seconds = fields.number("seconds"),
                        .source = fields.text("source"),
                        .others = fields.text("others"),
                        .found = fields.maybe("found"),
                        .why = fields.text("why")};
    if (!row.ceiling_is_high) row.high = fields.maybe("high");
    if (row.low.has_value() != (row.high.has_value() || row.ceiling_is_high))
        fields.fail("high", "allowed: both ends of a band, or neither");
    if (row.found.has_value() == row.why.empty())
        fields.fail("why", "allowed: a value that is known to be outside with its reason, or neither");
    if (row.found && !row.judged()) fields.fail("found", "allowed: only where there is a band");
    if (std::find(kKinds.begin(), kKinds.end(), row.kind) == kKinds.end())
        fields.fail("kind", "found \"" + row.kind + "\", allowed: closed_form, published, laboratory, bound");
    return row;
}

template <class Scenarios>
std::optional<std::string_view> find(const Scenarios& scenarios, std::string_view folder,
                                     const std::string& wanted) {
    for (const auto& scenario : scenarios)
        if (wanted == std::string(folder) + "/" + std::string(scenario.name)) return scenario.text;
    return std::nullopt;
}

/// "[joint.default] friction_deg = 18.0" taken apart.
struct Change {
    std::string header, key, value;
};

Change changeOf(const VerificationRow& row) {
    const auto end = row.set.rfind(']'), equals = row.set.find(" = ");
    if (end == std::string::npos || equals == std::string::npos || equals < end + 2)
        throw BadInput(
            Error{"set", "found \"" + row.set + "\", allowed: like [joint.default] friction_deg = 18.0"});
    return {row.set.substr(0, end + 1), row.set.substr(end + 2, equals - end - 2),
            row.set.substr(equals + 3)};
}

}  // namespace

std::vector<VerificationRow> readRows(std::string_view csv, const std::string& path) {
    std::vector<VerificationRow> rows;
    for (int number = 1; !csv.empty(); ++number) {
        const auto end = csv.find('\n');
        const std::string_view line = csv.substr(0, end);
        csv = end == std::string_view::npos ? std::string_view{} : csv.substr(end + 1);
        if (line.empty()) continue;
        const Fields fields(line, path, number);
        if (number == 1) {
            for (const std::string_view column : kColumns)
                if (fields.text(column) != column) fields.fail(column, "this column is missing");
            continue;
        }
        rows.push_back(rowOf(fields));
    }
    return rows;
}

std::vector<VerificationRow> verificationRows() { return readRows(kVerificationRows, std::string(kTable)); }

std::string scenarioText(const VerificationRow& row) {
    auto text = find(kPaperScenarios, "paper", row.scenario);
    if (!text) text = find(kExampleScenarios, "examples", row.scenario);
    if (!text) text = find(kVerificationScenarios, "verification", row.scenario);
    if (!text) throw BadInput(Error{"scenario", "there is no scenario \"" + row.scenario + "\""});
    if (row.set.empty()) return std::string(*text);
    const Change change = changeOf(row);
    return withValue(*text, change.header, change.key, change.value);
}

std::string scenarioName(const VerificationRow& row) {
    const std::string name = row.scenario.substr(row.scenario.find('/') + 1);
    if (row.set.empty()) return name;
    const Change change = changeOf(row);
    return name + "-" + change.key + "-" + change.value;
}

}  // namespace talus::tools
