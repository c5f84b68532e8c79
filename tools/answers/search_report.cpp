#include "answers/search_report.h"

#include <algorithm>
#include <cmath>

#include "answers/support_report.h"
#include "cli/block_names.h"
#include "cli/failures.h"
#include "cli/json.h"
#include "cli/provenance.h"
#include "cli/scenario.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "report/numbers.h"

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

/// "stands at 19.498, fails at 19.508"; an open end is left out. What an interrupted search has seen moving may still come to
/// rest.
std::string bracketText(const SearchReport& report) {
    const bool stands = std::isfinite(report.result.low), fails = std::isfinite(report.result.high);
    if (!stands && !fails) return "nothing is known yet";
    return (stands ? "stands at " + figureOf(report, report.result.low) : "") +
           (stands && fails ? ", " : "") +
           (fails ? (wasInterrupted(report.result) ? "seems to fail at " : "fails at ") +
                        figureOf(report, report.result.high)
                  : "");
}

std::string answerText(const SearchReport& report) {
    const SearchResult& result = report.result;
    const std::string unit = unitOf(report);
    switch (result.status) {
        case SearchStatus::found:
            return figureOf(report, result.answer) + unit + "  (" + bracketText(report) + ")";
        case SearchStatus::unstable_at_start:
            return "none: unstable at the start of the search, " + figureOf(report, result.high) + unit;
        case SearchStatus::stable_to_stop:
            return "none: stands to the end of the search, " + figureOf(report, result.low) + unit;
        case SearchStatus::interrupted:
        case SearchStatus::undecided:
            break;
    }
    return (wasInterrupted(result) ? "interrupted; so far: " : "undecided: ") + bracketText(report);
}

std::string theoryText(const SearchReport& report) {
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

std::string ceilingText(const SearchReport& report) {
    const Ceiling& ceiling = report.ceiling;
    return row("ceiling", ceiling.value ? figureOf(report, *ceiling.value) + unitOf(report) +
                                              "  (limit analysis, joints that open as they slide)"
                                        : "none: " + ceiling.reason);
}

std::string rangeText(const SearchReport& report) {
    const SearchResult& result = report.result;
    if (result.range)
        return row("range", figureOf(report, result.range->first) + " to " +
                                figureOf(report, result.range->second) + unitOf(report) + "  (" +
                                result.range_reason + ")");
    return result.range_reason.empty() ? "" : row("range", "none: " + result.range_reason);
}

std::string cohesionText(const SearchReport& report) {
    const std::optional<double>& kept = report.result.kept_cohesion;
    if (!kept) return "";
    return row("cohesion kept", figureOf(report, *kept) + unitOf(report) +
                                    "  (the answer, did joints not lose it as they slip: limit equilibrium)");
}

/// Or null, as the reason.
Json rangeJson(const SearchReport& report) {
    if (!report.result.range) return nullptr;
    const double scale = report.search.load->scale;
    return {number(report.result.range->first / scale), number(report.result.range->second / scale)};
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
                       " of the free blocks' mass; --groups 4 tells who goes next, and when; "
                       "analysis.least_mass_share lets such go on the way");
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
        rows += row(rows.empty() ? "let go before" : "",
                    betweenText(report, group) + ": " + std::to_string(group.blocks.size()) + " with " +
                        share + " of the mass: " + compactNames(group.blocks));
    }
    return rows;
}

/// The groups after the first, which is the answer.
std::string groupsText(const SearchResult& result) {
    std::string rows;
    for (std::size_t k = 1; k < result.groups.size(); ++k)
        rows += row("then go",
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
    return std::to_string(result.probes.size()) + " probes, " + std::to_string(result.steps) + " steps, " +
           std::to_string(result.factors) + " factorisations, " + text(result.wall_seconds, 2) +
           " s: " + share(result.time.stepping) + "steps, " + share(result.time.solving) +
           "implicit solve, " + share(result.time.watching) + "failures let go";
}

std::string methodText(const SearchResult& result) {
    return "local damping " + text(result.damping_local, 2) +
           (result.inertia_scaled ? ", inertia scaled" : "") + "; failure mode from " +
           text(result.continuation_seconds, 4) + " s with true inertia";
}

std::string sizeText(const SearchResult& result) {
    if (wasInterrupted(result) && result.interfaces == 0) return std::to_string(result.blocks) + " blocks";
    return std::to_string(result.blocks) + " blocks, " + std::to_string(result.interfaces) + " interfaces, " +
           std::to_string(result.contact_points) + " contact points";
}

std::string probeTable(const SearchReport& report) {
    std::string table = "\n" + figure("probe", 5) + figure("load" + unitOf(report), 12) + "  " +
                        word("verdict", 10) + figure("steps", 10) + figure("unbalanced", 12) +
                        figure("moved m", 10) + "  reason\n";
    for (std::size_t i = 0; i < report.result.probes.size(); ++i) {
        const Probe& probe = report.result.probes[i];
        table += figure(std::to_string(i + 1), 5) + figure(figureOf(report, probe.load), 12) + "  " +
                 word(toString(probe.verdict), 10) + figure(std::to_string(probe.steps), 10) +
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
            {"out_of_balance", number(probe.out_of_balance)},
            {"displacement_m", number(probe.displacement)},
            {"reason", probe.reason}};
}

Json groupJson(const BlockGroup& group) {
    return {{"factor", number(group.factor)}, {"blocks", group.blocks}};
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
    json["ceiling"] =
        report.ceiling.value ? number(*report.ceiling.value / search.load->scale) : Json(nullptr);
    json["ceiling_reason"] = report.ceiling.value ? Json(nullptr) : Json(report.ceiling.reason);
    json["range"] = rangeJson(report);
    json["range_reason"] = result.range_reason.empty() ? Json(nullptr) : Json(result.range_reason);
    json["joint_stiffness_factor"] = number(report.stiffness);
    json["kept_cohesion"] =
        result.kept_cohesion ? number(*result.kept_cohesion / search.load->scale) : Json(nullptr);
    json["lost_cohesion_share"] = number(result.lost_cohesion);
    json["failure_mode"] = toString(result.mode);
    json["moving_blocks"] = result.moving_blocks;
    json["moving_mass_share"] = number(massShare(report.scenario.model, result.moving_blocks));
    json["fallen_at_start"] = result.fallen_at_start;
    json["let_go"] = list(result.let_go, [&](const BlockGroup& group) {
        const double scale = search.load->scale;
        return Json{{search.answer_key, number(group.factor / scale)},
                    {search.keyInUnit("bracket"), {number(group.low / scale), number(group.high / scale)}},
                    {"blocks", group.blocks},
                    {"mass_share", number(massShare(report.scenario.model, group.blocks))}};
    });
    addSupports(result.supports, json);
    if (search.follows_groups) json["groups"] = list(result.groups, groupJson);
    json["theory"] = theoryJson(report);
    json["probes"] = result.probes.size();
    json["steps"] = result.steps;
    json["factorisations"] = result.factors;
    json["wall_seconds"] = number(result.wall_seconds);
    json["time_s"] = {{"steps", number(result.time.stepping)},
                      {"implicit_solve", number(result.time.solving)},
                      {"failures_let_go", number(result.time.watching)}};
    json["state_hash"] = hashText(result.state_hash);
    json["interrupted"] = wasInterrupted(result) || report.cut_short;
    json["warnings"] = warningsJson(report.scenario, result.warnings);
    json["blocks"] = result.blocks;
    json["interfaces"] = result.interfaces;
    json["contact_points"] = result.contact_points;
    json["time_step_s"] = number(result.time_step);
    json["inertia_scaled"] = result.inertia_scaled;
    json["damping_local"] = number(result.damping_local);
    json["continuation_seconds"] = number(result.continuation_seconds);
    json["probe_list"] = list(result.probes, [&](const Probe& probe) { return probeJson(report, probe); });
    json["evidence"] = list(result.motions, motionJson);
    if (report.kept) json["kept_run"] = keptRunJson(*report.kept);
    json["provenance"] = provenance(report.common, report.scenario.path);
    return json;
}

std::string searchText(const SearchReport& report, bool verbose) {
    const SearchResult& result = report.result;
    // Without an answer there is nothing beside it.
    const std::string beside = wasInterrupted(result)
                                   ? ""
                                   : theoryText(report) + ceilingText(report) + cohesionText(report) +
                                         rangeText(report) + row("failure mode", toString(result.mode)) +
                                         row("moving blocks", movingText(result)) + smallPartText(report);
    const std::string method = wasInterrupted(result) ? "" : row("method", methodText(result));
    std::string table = row("scenario", report.scenario.path) +
                        row(report.search.answer, answerText(report)) + beside + fallenText(result) +
                        letGoText(report) + groupsText(result) + supportsText(result) +
                        row("model", sizeText(result)) + method + row("cost", costText(result)) +
                        row("state hash", hashText(result.state_hash));
    for (const std::string& warning : result.warnings) table += row("warning", warning);
    if (report.kept)
        for (const auto& [label, content] : keptRunLines(*report.kept)) table += row(label, content);
    if (verbose) table += probeTable(report) + motionTable(result);
    return table;
}

}  // namespace talus::tools
