#pragma once
// Result rows: which columns a batch has, what one run's row holds, and both as CSV.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/json_fwd.h"
#include "report/csv.h"
#include "talus/formats/sweep.h"

namespace talus::tools::batch {

/// Of the columns with the ends of the answers of other loading histories; with the unit behind them.
inline constexpr const char *kRangeLow = "range_low", *kRangeHigh = "range_high";
/// With limit analysis beside the answer, with the unit behind it; and what was made of the joints for the
/// answer.
inline constexpr const char* kCeiling = "ceiling";
/// Of the columns with the groups that fail one after the other, the first included.
inline constexpr const char *kGroupFactors = "group_factors", *kGroupBlocks = "group_blocks";
/// Between groups, in these columns.
inline constexpr const char* kBetweenGroups = "; ";
inline constexpr const char *kIntervalLow = "interval_low", *kIntervalHigh = "interval_high";

/// One column of results.csv.
struct Column {
    enum class Role : std::uint8_t { key, varied, result };
    std::string name;
    std::string type;   ///< of CSV on the Web: "integer", "number", "string", "boolean"
    std::string unit;   ///< "deg", "Pa", ...; "" without one
    std::string about;  ///< for people
    Role role = Role::result;
    std::string source{};  ///< of what varies: "grid", "table", "random", "interfaces"
};

/// Description of a batch's rows, so that results can be merged and reported without the sweep file. Kept as
/// batch.json beside the results.
struct BatchInfo {
    std::string identity, analysis, sweep, scenario, sweep_text, scenario_text;
    std::uint64_t runs = 0, cases = 1, samples = 1, seed = 1;
    bool latin_hypercube = false;
    std::vector<std::string> case_names;
    std::vector<double> thresholds;  ///< of the answer, in its unit, at which failure is asked for
    double confidence = 0.95;
    std::vector<Column> columns;

    const LoadSearch* search() const { return loadSearch(analysis); }  ///< nullptr: time histories
    std::string answerName() const;   ///< the column that is the answer: "critical_angle_deg", ...
    std::string answerTitle() const;  ///< "critical angle (°)"
    std::string unitSymbol() const;   ///< of the answer, behind a figure: "°"
    bool triesHistories() const;      ///< its rows have the answers of other loading histories
    std::string keyInUnit(std::string_view key) const;  ///< "bracket_low" -> "bracket_low_deg"
    std::optional<std::size_t> find(std::string_view column) const;
};

BatchInfo describe(const formats::Sweep& sweep);
Json toJson(const BatchInfo& info);
BatchInfo infoFromJson(const Json& json);  ///< throws nlohmann's errors

/// Cells of one run's row, in the order of the columns.
using Row = std::vector<std::string>;

std::string csvHeader(const BatchInfo& info);

/// Types and units of the columns, as the standard CSV on the Web (https://www.w3.org/TR/tabular-metadata/)
/// has them.
Json csvMetadata(const BatchInfo& info, const std::string& file);

/// Whether a run with this status counts as failed: it has no result, or an undecided one.
bool isFailure(std::string_view status);

}  // namespace talus::tools::batch
