#include "answers/storm.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cli/block_names.h"
#include "cli/failures.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/provenance.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "report/csv.h"
#include "report/svg.h"
#include "report/table.h"

namespace talus::tools {

namespace {

constexpr double kHour = 3600;  // [s]

std::string row(std::string label, const std::string& content) {
    label.resize(std::max<std::size_t>(label.size() + 1, 18), ' ');
    return label + content + "\n";
}

std::string hours(double seconds) { return text(seconds / kHour, 2) + " h"; }

Json factorJson(const StormPoint& point) {
    return point.status == SearchStatus::found ? number(point.factor) : Json(nullptr);
}

Json pointJson(const StormPoint& point) {
    const bool has_bracket = point.status == SearchStatus::found && !point.interpolated;
    Json levels = Json::array(), strengths = Json::array();
    for (const double level : point.levels) levels.push_back(number(level));
    for (const double strength : point.strengths) strengths.push_back(number(strength));
    return {{"time_s", number(point.time)},
            {"level_m", point.levels.empty() ? Json(nullptr) : number(point.levels.front())},
            {"safety_factor", factorJson(point)},
            {"status", toString(point.status)},
            {"bracket", has_bracket ? Json{number(point.low), number(point.high)} : Json(nullptr)},
            {"failure_mode", toString(point.mode)},
            {"interpolated", point.interpolated},
            {"levels_m", levels},
            {"strengths", strengths}};
}

Json waterJson(const WaterReport& water) {
    return {{"name", water.name},
            {"level_m", number(water.level)},
            {"volume_m3", number(water.volume)},
            {"run_over_m3", number(water.run_over)},
            {"leaked_m3", number(water.leaked)}};
}

bool isUndecided(const StormPoint& point) {
    return point.status == SearchStatus::undecided || point.status == SearchStatus::interrupted;
}

bool allFound(const StormResult& result) {
    return !result.points.empty() && std::none_of(result.points.begin(), result.points.end(), isUndecided);
}

Json originJson(const StormPoint& point) {
    if (isUndecided(point)) return nullptr;
    return point.interpolated ? "interpolation" : "search";
}

/// ", with 0.400 times the strength of clay, 0.990 of ice": those that differ from 1, the least first.
std::string strengthsText(const std::vector<std::string>& joints, const std::vector<double>& strengths) {
    constexpr std::size_t kMost = 3;  // joints on a line; the table has all
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < strengths.size(); ++k)
        if (strengths[k] != 1) order.push_back(k);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return strengths[a] < strengths[b]; });
    std::string words;
    for (std::size_t n = 0; n < std::min(order.size(), kMost); ++n)
        words += (n == 0 ? ", with " : ", ") + text(strengths[order[n]], 3) +
                 (n == 0 ? " times the strength of " : " of ") + joints[order[n]];
    if (order.size() > kMost) words += " and " + std::to_string(order.size() - kMost) + " more";
    return words;
}

std::string leastText(const StormResult& result) {
    if (!result.least) return result.interrupted ? "interrupted" : "undecided";
    const StormPoint& point = result.points[*result.least];
    std::string when = " after " + hours(point.time);
    if (!point.levels.empty()) when += ", at a level of " + text(point.levels.front(), 3) + " m";
    when += strengthsText(result.joints, point.strengths);
    if (point.status == SearchStatus::unstable_at_start) return "unstable whatever the strength" + when;
    if (point.status == SearchStatus::stable_to_stop) return "stable at any factor that was tried";
    return text(point.factor, 4) + when + " (" + toString(point.mode) + ")";
}

std::string failureText(const StormResult& result) {
    if (!result.failure_time) return allFound(result) ? "never" : "not known";
    return "after " + hours(*result.failure_time) + "; later factors assume that the slope has not moved";
}

std::string balanceText(const WaterReport& water) {
    return "level " + text(water.level, 3) + " m, " + text(water.volume, 4) + " m3 in the fissure, " +
           text(water.leaked, 4) + " m3 leaked, " + text(water.run_over, 4) + " m3 have run over";
}

Table tableOf(const StormResult& result) {
    Table table{{"time_s"}, {}};
    for (const std::string& water : result.waters) table.columns.push_back(water + ".level_m");
    for (const std::string& joints : result.joints) table.columns.push_back("strength of " + joints);
    for (const char* column : {"safety_factor", "low", "high", "status", "failure_mode", "from"})
        table.columns.emplace_back(column);
    for (const StormPoint& point : result.points) {
        const bool found = point.status == SearchStatus::found;
        std::vector<Json> cells{number(point.time)};
        for (const double level : point.levels) cells.push_back(number(level));
        for (const double strength : point.strengths) cells.push_back(number(strength));
        for (const double value : {point.factor, point.low, point.high})
            cells.push_back(found ? number(value) : Json(nullptr));
        for (const char* word : {toString(point.status), toString(point.mode)}) cells.emplace_back(word);
        cells.push_back(originJson(point));
        table.rows.push_back(std::move(cells));
    }
    return table;
}

/// Settings are named as the options that give them.
Result<StormResult> byOption(Result<StormResult> result) {
    if (result) return result;
    std::vector<Error> errors = result.errors();
    for (Error& error : errors)
        for (const char* setting : {"duration", "step"})
            if (error.field == setting) error.field = std::string("--") + setting + "-s";
    return errors;
}

}  // namespace

StormResult stormOf(const formats::Scenario& scenario, const StormRequest& request, const Common& common,
                    const Control& control) {
    requireFreeBlock(scenario);
    refuseOutput("--plot", request.plot, ".svg");
    refuseOutput("--csv", request.csv, ".csv");
    StormResult result = valueOf(byOption(storm(scenario.model, request.settings, control)), scenario);
    const std::string comments = provenanceComments(common, scenario.path);
    if (!request.csv.empty()) writeFile(request.csv, stormCsv(result, comments));
    if (!request.plot.empty()) writeFile(request.plot, svgFile(stormPlot(result, scenario.path), true));
    return result;
}

int exitCode(const StormResult& result) {
    if (result.interrupted) return kInterrupted;
    return allFound(result) ? kDone : kUndecided;
}

Json stormJson(const StormResult& result, const formats::Scenario& scenario, const Common& common) {
    Json times = Json::array(), waters = Json::array();
    for (const StormPoint& point : result.points) times.push_back(pointJson(point));
    for (const WaterReport& water : result.at_end) waters.push_back(waterJson(water));
    return {{"status", allFound(result) ? "found" : "undecided"},
            {"least", result.least ? pointJson(result.points[*result.least]) : Json(nullptr)},
            {"failure_time_s", result.failure_time ? number(*result.failure_time) : Json(nullptr)},
            {"moving_blocks", result.moving_blocks},
            {"waters", result.waters},
            {"joints", result.joints},
            {"times", times},
            {"at_end", waters},
            {"searches", result.searches},
            {"wall_seconds", number(result.wall_seconds)},
            {"interrupted", result.interrupted},
            {"warnings", warningsJson(scenario, result.warnings)},
            {"provenance", provenance(common, scenario.path)}};
}

std::string stormText(const StormResult& result, const formats::Scenario& scenario) {
    std::string lines = row("scenario", scenario.path) + row("least factor", leastText(result)) +
                        row("falls below 1", failureText(result));
    if (!result.moving_blocks.empty())
        lines += row("moving blocks",
                     std::to_string(result.moving_blocks.size()) + ": " + compactNames(result.moving_blocks));
    for (const WaterReport& water : result.at_end) lines += row(water.name, balanceText(water));
    for (const std::string& warning : warningsOf(scenario, result.warnings)) lines += row("warning", warning);
    return lines +
           row("cost", std::to_string(result.points.size()) + " times, " + std::to_string(result.searches) +
                           " searches, " + text(result.wall_seconds, 2) + " s") +
           "\n" + tableOf(result).text();
}

std::string stormCsv(const StormResult& result, const std::string& comments) {
    return comments + tableOf(result).csv();
}

}  // namespace talus::tools
