#include "answers/search_report.h"

#include <algorithm>
#include <cmath>

#include "answers/search_plot.h"
#include "answers/support_report.h"
#include "cli/block_names.h"
#include "cli/failures.h"
#include "cli/json.h"
#include "cli/provenance.h"
#include "cli/scenario.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "report/numbers.h"
#include "talus/limit_analysis.h"

namespace talus::tools {

namespace {

/// As in JSON; "undecided" when interrupted.
std::string statusText(SearchStatus status) {
    return toString(status == SearchStatus::interrupted ? SearchStatus::undecided : status);
}

bool wasInterrupted(const SearchResult& result) {
    // A probe that was cut short is undecided, too.
    return result.status == SearchStatus::interrupted ||
           (result.status == SearchStatus::undecided && stopRequested());
}

/// A load, or a difference of loads, without its unit.
std::string figureOf(const SearchReport& report, double load) {
    return loadFigure(report.search, load, report.search.load->decimals);
}

/// The upper bound, where the answer lies above it: at most by what its bracket leaves open, as a rule.
std::optional<double> boundBelow(const SearchReport& report) {
    const SearchResult& result = report.result;
    const auto& bound = result.upper_bound.value;
    return result.status == SearchStatus::found && bound && *bound < result.answer ? bound : std::nullopt;
}

/// The middle of a bracket that an upper bound cuts through is told no higher than the bound: the answer is
/// below both.
std::string answerFigure(const SearchReport& report, double load) {
    const auto bound = boundBelow(report);
    const bool cuts = bound && *bound >= report.result.low && load <= report.result.answer;
    return figureOf(report, cuts ? std::min(load, *bound) : load);
}

/// " deg" or "".
std::string unitOf(const SearchReport& report) {
    return *report.search.load->unit == '\0' ? "" : " " + std::string(report.search.load->unit);
}

/// A line of the table: the label in its column, then the content.
std::string row(const std::string& label, const std::string& content) {
    constexpr std::size_t kColumn = 18;
    return label + std::string(kColumn - std::min(kColumn - 1, label.size()), ' ') + content + "\n";
}

/// The text filled up with spaces to `width`, on its left (figures) or right (words).
std::string figure(const std::string& content, std::size_t width) {
    return std::string(width - std::min(width, content.size()), ' ') + content;
}
std::string word(const std::string& content, std::size_t width) {
    return content + std::string(width - std::min(width, content.size()), ' ');
}

std::string scientific(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.1e", value);
    return buffer;
}

/// "stands at 19.498, fails at 19.508"; an open end is left out. What an interrupted search has seen moving
/// may still come to rest.
std::string bracketText(const SearchReport& report) {
    const bool stands = std::isfinite(report.result.low), fails = std::isfinite(report.result.high);
    if (!stands && !fails) return "nothing is known yet";
    return (stands ? "stands at " + figureOf(report, report.result.low) : "") +
           (stands && fails ? ", " : "") +
           (fails ? (wasInterrupted(report.result) ? "seems to fail at " : "fails at ") +
                        figureOf(report, report.result.high)
                  : "");
}

/// The headline's interval: the lowest and the highest answer found.
std::string intervalText(const SearchReport& report) {
    const auto& interval = report.result.answer_interval;
    if (!interval) return "";
    return ", interval " + answerFigure(report, interval->first) + " to " +
           answerFigure(report, interval->second);
}

std::string answerText(const SearchReport& report) {
    const SearchResult& result = report.result;
    const std::string unit = unitOf(report);
    switch (result.status) {
        case SearchStatus::found:
            return answerFigure(report, result.answer) + unit + intervalText(report) + "  (" +
                   bracketText(report) + ")";
        case SearchStatus::unstable_at_start:
            return "none: unstable at the start of the search, " + figureOf(report, result.high) + unit;
        case SearchStatus::stable_to_stop:
            return "none: stable up to the largest load tried, " + figureOf(report, result.low) + unit;
        case SearchStatus::interrupted:
        case SearchStatus::undecided:
            break;
    }
    return (wasInterrupted(result) ? "interrupted; so far: " : "undecided: ") + bracketText(report);
}

std::string theoryText(const SearchReport& report) {
    if (!report.theory && report.result.limit_equilibrium) {
        const LimitEquilibrium& limit = *report.result.limit_equilibrium;
        return row("limit equilibrium", figureOf(report, limit.value) + "  (" + limit.kind +
                                            ", translation only: " + compactNames(limit.blocks) + ")");
    }
    if (!report.theory) {
        return row("theory",
                   report.cut_short ? "none found before the interruption" : "no closed formula applies");
    }
    std::string line = figureOf(report, report.theory->value) + unitOf(report);
    if (report.result.status == SearchStatus::found)
        line += "  (computed minus theory: " + figureOf(report, report.result.answer - report.theory->value) +
                ")";
    return row("theory", line) + row("", report.theory->prediction.formula);
}

/// Where the figures would have the answer above its bound, how that can be; a warning tells of more than
/// that.
std::string aboveText(const SearchReport& report) {
    const SearchResult& result = report.result;
    const auto bound = boundBelow(report);
    if (!bound || figureOf(report, result.answer) == figureOf(report, *bound) ||
        isAbove(result.low, result.upper_bound, report.search.load->varied))
        return "";
    if (*bound >= result.low) return "; it lies in the answer's bracket";
    return "; the answer is higher by " + figureOf(report, result.answer - *bound) + unitOf(report) +
           ", because joints deform before they fail";
}

std::string upperBoundText(const SearchReport& report) {
    const Ceiling& bound = report.result.upper_bound;
    return row("upper bound", bound.value ? figureOf(report, *bound.value) + unitOf(report) +
                                                "  (limit analysis, joints that open as they slide" +
                                                aboveText(report) + ")"
                                          : "none: " + bound.reason);
}

std::string intervalReasons(const SearchReport& report) {
    const auto& [low, high] = report.result.answer_interval_reasons;
    if (!report.result.answer_interval) return "";
    return row("interval", "low: " + low) + row("", "high: " + high);
}

/// The answers by other failure displacements, where they differ.
std::string displacementText(const SearchReport& report) {
    std::string answers;
    for (const DisplacementAnswer& other : report.result.answers_by_displacement)
        answers += (answers.empty() ? "" : ", ") + scientific(other.displacement) + ": " +
                   figureOf(report, other.load);
    if (answers.empty()) return "";
    return row("by displacement",
               answers + "  (answers for other failure displacements, as shares of a block; here " +
                   scientific(report.result.failure_displacement) + ")");
}

std::string cohesionText(const SearchReport& report) {
    const std::optional<double>& kept = report.result.kept_cohesion;
    if (!kept) return "";
    return row("cohesion kept", figureOf(report, *kept) + unitOf(report) +
                                    "  (the answer if joints kept it as they slip, as in limit equilibrium)");
}

/// [low, high] where another loading path gives less, else null.
Json rangeJson(const SearchReport& report) {
    const auto& interval = report.result.answer_interval;
    if (!interval || !(interval->first < report.result.answer)) return nullptr;
    const double scale = report.search.load->scale;
    return {number(interval->first / scale), number(report.result.answer / scale)};
}

Json intervalJson(const SearchReport& report) {
    const auto& interval = report.result.answer_interval;
    if (!interval) return nullptr;
    const double scale = report.search.load->scale;
    return {number(interval->first / scale), number(interval->second / scale)};
}

std::string movingText(const SearchResult& result) {
    if (result.moving_blocks.empty()) return "none";
    const std::string of =
        result.motions.empty() ? "" : " of " + std::to_string(result.motions.size()) + " free";
    return std::to_string(result.moving_blocks.size()) + of + ": " + compactNames(result.moving_blocks);
}

std::string percentText(double share) {
    constexpr double kLeastTold = 1e-4;
    return (share < kLeastTold ? "less than 0.01" : text(100 * share, share < 0.01 ? 2 : 1)) + " %";
}

/// An answer that is one of a small part of the slope says so, with the way to the rest.
std::string smallPartText(const SearchReport& report) {
    constexpr double kSmall = 0.05;
    const double share = massShare(report.scenario.model, report.result.moving_blocks);
    if (!report.search.follows_groups || report.result.groups.size() > 1 || !(share > 0 && share < kSmall))
        return "";
    return row("", "these have " + percentText(share) +
                       " of the free blocks' mass; --groups 4 finds the groups that fail next; "
                       "analysis.least_mass_share removes such small groups before the answer");
}

std::string fallenText(const SearchResult& result) {
    if (result.fallen_at_start.empty()) return "";
    return row("fallen at start",
               std::to_string(result.fallen_at_start.size()) + ": " + compactNames(result.fallen_at_start));
}

std::string betweenText(const SearchReport& report, const BlockGroup& group) {
    if (group.low == group.high) return "at " + figureOf(report, group.factor) + unitOf(report);
    return "between " + figureOf(report, group.low) + " and " + figureOf(report, group.high) + unitOf(report);
}

/// What failed before and was too little to be the answer.
std::string letGoText(const SearchReport& report) {
    std::string rows;
    for (const BlockGroup& group : report.result.let_go) {
        const std::string share = percentText(massShare(report.scenario.model, group.blocks));
        rows += row(rows.empty() ? "removed before" : "",
                    betweenText(report, group) + ": " + std::to_string(group.blocks.size()) + " with " +
                        share + " of the mass: " + compactNames(group.blocks));
    }
    return rows;
}

/// The groups after the first, which is the answer.
std::string groupsText(const SearchResult& result) {
    std::string rows;
    for (std::size_t k = 1; k < result.groups.size(); ++k)
        rows += row("then fail",
                    "at " + text(result.groups[k].factor, 4) + ": " + compactNames(result.groups[k].blocks));
    return rows;
}

std::string supportsText(const SearchResult& result) {
    std::string rows;
    for (const SupportTexts& kind : supportTexts(result.supports))
        for (const std::string& line : kind.lines)
            rows += row(&line == &kind.lines.front() ? kind.kind : "", line);
    return rows;
}

std::string costText(const SearchResult& result) {
    const auto share = [&](double seconds) {
        return text(result.wall_seconds > 0 ? 100 * seconds / result.wall_seconds : 0.0, 0) + " % ";
    };
    return std::to_string(result.steps) + " steps, " + std::to_string(result.factors) + " factorisations, " +
           text(result.wall_seconds, 2) + " s: " + share(result.time.loading) + "loading, " +
           share(result.time.path) + "path, " + share(result.time.beside) + "interval, bound and groups";
}

std::string sizeText(const SearchResult& result) {
    if (wasInterrupted(result) && result.interfaces == 0) return std::to_string(result.blocks) + " blocks";
    return std::to_string(result.blocks) + " blocks, " + std::to_string(result.interfaces) + " interfaces, " +
           std::to_string(result.contact_points) + " contact points";
}

std::string probeTable(const SearchReport& report) {
    std::string table = "\n" + figure("step", 5) + figure("load" + unitOf(report), 12) + "  " +
                        word("verdict", 10) + figure("factors", 10) + figure("unbalanced", 12) +
                        figure("moved m", 10) + "  reason\n";
    for (std::size_t i = 0; i < report.result.probes.size(); ++i) {
        const Probe& probe = report.result.probes[i];
        table += figure(std::to_string(i + 1), 5) + figure(figureOf(report, probe.load), 12) + "  " +
                 word(toString(probe.verdict), 10) + figure(std::to_string(probe.factors), 10) +
                 figure(scientific(probe.out_of_balance), 12) + figure(scientific(probe.displacement), 10) +
                 "  " + probe.reason + "\n";
    }
    return table;
}

std::string motionTable(const SearchResult& result) {
    std::string table = "\n" + word("block", 16) + word("moves by", 10) + figure("moved m", 10) +
                        figure("turned deg", 12) + figure("turning", 9) + figure("open", 7) +
                        figure("mobilised", 11) + "\n";
    for (const BlockMotion& motion : result.motions)
        table += word(motion.block, 16) + word(toString(motion.mode), 10) +
                 figure(scientific(motion.translation.norm()), 10) +
                 figure(text(degrees(motion.rotation), 4), 12) + figure(text(motion.rotation_share, 2), 9) +
                 figure(text(motion.open_share, 2), 7) + figure(text(motion.mobilised_friction, 3), 11) +
                 "\n";
    return table;
}

Json probeJson(const SearchReport& report, const Probe& probe) {
    return {{report.search.load->key, number(probe.load / report.search.load->scale)},
            {"verdict", toString(probe.verdict)},
            {"steps", probe.steps},
            {"factorisations", probe.factors},
            {"out_of_balance", number(probe.out_of_balance)},
            {"displacement_m", number(probe.displacement)},
            {"reason", probe.reason}};
}

Json groupJson(const BlockGroup& group) {
    return {{"factor", number(group.factor)},
            {"blocks", group.blocks},
            {"volume_m3", number(group.volume)},
            {"mass_kg", number(group.mass)}};
}

Json motionJson(const BlockMotion& motion) {
    return {{"block", motion.block},
            {"mode", toString(motion.mode)},
            {"moving", motion.moving},
            {"translation_m", vector(motion.translation)},
            {"rotation_deg", number(degrees(motion.rotation))},
            {"rotation_share", number(motion.rotation_share)},
            {"open_share", number(motion.open_share)},
            {"mobilised_friction", number(motion.mobilised_friction)}};
}

Json rulesJson() {
    const SearchRules rules;
    Json json = Json::object();
    for (const SearchRule& rule : searchRules()) json[rule.name] = number(rules.*rule.value);
    return json;
}

std::string rulesTable() {
    const SearchRules rules;
    std::string table = "\n" + word("rule", 24) + figure("value", 10) + "  meaning\n";
    for (const SearchRule& rule : searchRules())
        table += word(rule.name, 24) + figure(text(rules.*rule.value, 6), 10) + "  " + rule.meaning + " [" +
                 rule.unit + "]; " + rule.effect + "\n";
    return table;
}

/// Null unless found.
Json answerJson(const SearchReport& report) {
    if (report.result.status != SearchStatus::found) return nullptr;
    return number(report.result.answer / report.search.load->scale);
}

/// [low, high], null at an open end.
Json bracketJson(const SearchReport& report) {
    return Json::array({number(report.result.low / report.search.load->scale),
                        number(report.result.high / report.search.load->scale)});
}

Json theoryJson(const SearchReport& report) {
    if (!report.theory) return nullptr;
    const theory::Prediction& prediction = report.theory->prediction;
    return {{"formula", prediction.formula},
            {"failure_mode", prediction.topples ? "toppling" : "sliding"},
            {"applies_because", prediction.applies_because}};
}

/// What a formula says of this load; where none recognises the model, block theory. Null where neither
/// applies.
Json limitEquilibriumJson(const SearchReport& report) {
    if (!report.theory && report.result.limit_equilibrium) {
        const LimitEquilibrium& limit = *report.result.limit_equilibrium;
        return {{"value", number(limit.value)}, {"kind", limit.kind}, {"blocks", limit.blocks}};
    }
    if (!report.theory) return nullptr;
    const theory::Prediction& prediction = report.theory->prediction;
    return {{"value", number(report.theory->value / report.search.load->scale)},
            {"kind", prediction.kind()},
            {"blocks", prediction.blocks}};
}

template <class T, class F>
Json list(const std::vector<T>& items, F&& json_of) {
    Json result = Json::array();
    for (const T& item : items) result.push_back(json_of(item));
    return result;
}

}  // namespace

int exitCode(const SearchReport& report) {
    if (wasInterrupted(report.result) || report.cut_short) return kInterrupted;
    if (report.kept && report.kept->exit_code != kDone) return report.kept->exit_code;
    for (const DrawnFile& drawn : report.drawn)
        if (drawn.exit_code != kDone) return drawn.exit_code;
    const bool sure = report.result.status != SearchStatus::undecided && !report.result.groups_undecided;
    return sure ? kDone : kUndecided;
}

Json searchJson(const SearchReport& report) {
    const LoadSearch& search = report.search;
    const SearchResult& result = report.result;
    Json json{{"status", statusText(result.status)},
              {search.answer_key, answerJson(report)},
              {search.keyInUnit("bracket"), bracketJson(report)},
              {search.theory_key,
               report.theory ? number(report.theory->value / search.load->scale) : Json(nullptr)}};
    if (search.load->varied != Varied::tilt)
        json["tilt_deg"] = number(degrees(report.scenario.model.gravity.tilt));
    const double scale = search.load->scale;
    const Ceiling& bound = result.upper_bound;
    json["ceiling"] = bound.value ? number(*bound.value / scale) : Json(nullptr);
    json["ceiling_reason"] = bound.value ? Json(nullptr) : Json(bound.reason);
    json["upper_bound"] = json["ceiling"];
    json["answer_interval"] = intervalJson(report);
    json["answer_interval_reasons"] = result.answer_interval ? Json{result.answer_interval_reasons.first,
                                                                    result.answer_interval_reasons.second}
                                                             : Json(nullptr);
    json["range"] = rangeJson(report);
    json["range_reason"] =
        result.answer_interval ? Json(result.answer_interval_reasons.first) : Json(nullptr);
    json["failure_displacement"] = number(result.failure_displacement);
    json["failure_displacement_m"] = number(failureDisplacement(result, report.scenario.model));
    json["answers_by_displacement"] =
        list(result.answers_by_displacement, [&](const DisplacementAnswer& other) {
            return Json{{"displacement", number(other.displacement)}, {"load", number(other.load / scale)}};
        });
    json["path"] = list(result.path, [&](const PathPoint& point) {
        return Json{{"load", number(point.load / scale)}, {"displacement_m", number(point.displacement)}};
    });
    json["failing_volume_m3"] = number(result.failing_volume);
    json["failing_mass_kg"] = number(result.failing_mass);
    json["kept_cohesion"] =
        result.kept_cohesion ? number(*result.kept_cohesion / search.load->scale) : Json(nullptr);
    json["lost_cohesion_share"] = number(result.lost_cohesion);
    json["failure_mode"] = toString(result.mode);
    json["moving_blocks"] = result.moving_blocks;
    json["moving_mass_share"] = number(massShare(report.scenario.model, result.moving_blocks));
    json["fallen_at_start"] = result.fallen_at_start;
    json["let_go"] = list(result.let_go, [&](const BlockGroup& group) {
        return Json{{search.answer_key, number(group.factor / scale)},
                    {search.keyInUnit("bracket"), {number(group.low / scale), number(group.high / scale)}},
                    {"blocks", group.blocks},
                    {"mass_share", number(massShare(report.scenario.model, group.blocks))},
                    {"volume_m3", number(group.volume)},
                    {"mass_kg", number(group.mass)}};
    });
    json["removed_blocks"] = json["let_go"];
    addSupports(result.supports, json);
    if (search.follows_groups) json["groups"] = list(result.groups, groupJson);
    json["theory"] = theoryJson(report);
    json["limit_equilibrium"] = limitEquilibriumJson(report);
    json["probes"] = result.probes.size();
    json["steps"] = result.steps;
    json["factorisations"] = result.factors;
    json["wall_seconds"] = number(result.wall_seconds);
    json["time_s"] = {{"loading", number(result.time.loading)},
                      {"path", number(result.time.path)},
                      {"beside", number(result.time.beside)}};
    json["state_hash"] = hashText(result.state_hash);
    json["interrupted"] = wasInterrupted(result) || report.cut_short;
    json["warnings"] = warningsJson(report.scenario, result.warnings);
    json["blocks"] = result.blocks;
    json["interfaces"] = result.interfaces;
    json["contact_points"] = result.contact_points;
    json["search_rules"] = rulesJson();
    json["probe_list"] = list(result.probes, [&](const Probe& probe) { return probeJson(report, probe); });
    json["evidence"] = list(result.motions, motionJson);
    if (report.kept) json["kept_run"] = keptRunJson(*report.kept);
    for (const DrawnFile& drawn : report.drawn) json[drawn.key] = drawnFileJson(drawn);
    json["provenance"] = provenance(report.common, report.scenario.path);
    return json;
}

std::string searchText(const SearchReport& report, bool verbose) {
    const SearchResult& result = report.result;
    // Without an answer there is nothing beside it.
    const std::string beside = wasInterrupted(result)
                                   ? ""
                                   : theoryText(report) + upperBoundText(report) + cohesionText(report) +
                                         intervalReasons(report) + displacementText(report) +
                                         row("failure mode", toString(result.mode)) +
                                         row("moving blocks", movingText(result)) + smallPartText(report);
    std::string table = row("scenario", report.scenario.path) +
                        row(report.search.answer, answerText(report)) + beside + fallenText(result) +
                        letGoText(report) + groupsText(result) + supportsText(result) +
                        row("model", sizeText(result)) + row("cost", costText(result)) +
                        row("state hash", hashText(result.state_hash));
    for (const std::string& warning : result.warnings) table += row("warning", warning);
    if (report.kept)
        for (const auto& [label, content] : keptRunLines(*report.kept)) table += row(label, content);
    for (const DrawnFile& drawn : report.drawn)
        table += row(drawn.key, drawn.file.empty() ? "none: " + drawn.reason : drawn.file);
    if (verbose) table += probeTable(report) + motionTable(result) + rulesTable();
    return table;
}

}  // namespace talus::tools
