#include "answers/search_report.h"

#include <algorithm>
#include <cmath>

#include "answers/flow_report.h"
#include "answers/search_lines.h"
#include "answers/search_plot.h"
#include "answers/support_report.h"
#include "cli/failures.h"
#include "cli/json.h"
#include "cli/provenance.h"
#include "cli/scenario.h"
#include "cli/text.h"

namespace talus::tools {

namespace {

/// As in JSON; "undecided" when interrupted.
std::string statusText(SearchStatus status) {
    return toString(status == SearchStatus::interrupted ? SearchStatus::undecided : status);
}

/// A line of the table: the label in its column, then the content.
std::string row(const ResultLine& line) {
    constexpr std::size_t kColumn = 18;
    return line.label + std::string(kColumn - std::min(kColumn - 1, line.label.size()), ' ') + line.content +
           "\n";
}

std::string rows(const ResultLines& lines) {
    std::string table;
    for (const ResultLine& line : lines) table += row(line);
    return table;
}

/// The text filled up with spaces to `width`, on its left (figures) or right (words).
std::string figure(const std::string& content, std::size_t width) {
    return std::string(width - std::min(width, content.size()), ' ') + content;
}
std::string word(const std::string& content, std::size_t width) {
    return content + std::string(width - std::min(width, content.size()), ' ');
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

/// The load by a closed formula; where none applies, by block theory. Null where neither applies.
Json limitEquilibriumJson(const SearchReport& report) {
    if (!report.theory && report.result.limit_equilibrium) {
        const LimitEquilibrium& limit = *report.result.limit_equilibrium;
        return {{"value", number(limit.value / report.search.load->scale)},
                {"kind", limit.kind},
                {"blocks", limit.blocks}};
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
    json["let_go"] = list(result.removed_groups, [&](const BlockGroup& group) {
        return Json{{search.answer_key, number(group.factor / scale)},
                    {search.keyInUnit("bracket"), {number(group.low / scale), number(group.high / scale)}},
                    {"blocks", group.blocks},
                    {"mass_share", number(massShare(report.scenario.model, group.blocks))},
                    {"volume_m3", number(group.volume)},
                    {"mass_kg", number(group.mass)}};
    });
    json["removed_blocks"] = json["let_go"];
    json["flow_coupling"] = couplingJson(result.flow_coupling);
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
    std::string table = row({"scenario", report.scenario.path}) + rows(answerLines(report));
    // Without an answer there are no secondary results.
    if (!wasInterrupted(result))
        table += rows(besideLines(report)) + rows(intervalLines(report)) + rows(failureLines(report));
    table += rows(groupLines(report)) + rows(supportLines(report)) + row({"model", sizeText(result)}) +
             row({"cost", costText(result)}) + row({"state hash", hashText(result.state_hash)});
    for (const std::string& warning : warningsOf(report.scenario, result.warnings))
        table += row({"warning", warning});
    if (report.kept)
        for (const auto& [label, content] : keptRunLines(*report.kept)) table += row({label, content});
    for (const DrawnFile& drawn : report.drawn)
        table += row({drawn.key, drawn.file.empty() ? "none: " + drawn.reason : drawn.file});
    if (verbose) table += probeTable(report) + motionTable(result) + rulesTable();
    return table;
}

}  // namespace talus::tools
