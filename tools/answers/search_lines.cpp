#include "answers/search_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "answers/flow_report.h"
#include "answers/support_report.h"
#include "cli/block_names.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "report/numbers.h"
#include "talus/limit_analysis.h"

namespace talus::tools {

namespace {

/// The upper bound, where the answer exceeds it: usually by less than its bracket.
std::optional<double> boundBelow(const SearchReport& report) {
    const SearchResult& result = report.result;
    const auto& bound = result.upper_bound.value;
    return result.status == SearchStatus::found && bound && *bound < result.answer ? bound : std::nullopt;
}

/// The middle of a bracket that contains the upper bound is reported no higher than the bound: the answer is
/// below both.
std::string answerFigure(const SearchReport& report, double load) {
    const auto bound = boundBelow(report);
    const bool cuts = bound && *bound >= report.result.low && load <= report.result.answer;
    return figureOf(report, cuts ? std::min(load, *bound) : load);
}

ResultLines line(const std::string& label, const std::string& content) { return {{label, content}}; }

ResultLines operator+(ResultLines lines, const ResultLines& more) {
    lines.insert(lines.end(), more.begin(), more.end());
    return lines;
}

/// "stands at 19.498, fails at 19.508"; an open end is left out. Blocks that move when a search is
/// interrupted may still reach equilibrium.
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

ResultLines theoryText(const SearchReport& report) {
    if (!report.theory && report.result.limit_equilibrium) {
        const LimitEquilibrium& limit = *report.result.limit_equilibrium;
        return line("limit equilibrium", figureOf(report, limit.value) + unitOf(report) + "  (" + limit.kind +
                                             (limit.translation_only ? ", translation only: " : ": ") +
                                             compactNames(limit.blocks) + ")");
    }
    const std::optional<Flow>& flow = report.scenario.model.flow;
    if (!report.theory && flow && flow->coupled)
        return line("limit equilibrium", "left out: it opens no joints, and [flow] is coupled to them");
    if (!report.theory && report.search.load->varied == Varied::tilt && flow)
        return line("limit equilibrium", "left out: it would compute [flow] anew at each tilt");
    if (!report.theory) {
        return line("theory",
                    report.cut_short ? "none found before the interruption" : "no closed formula applies");
    }
    std::string figures = figureOf(report, report.theory->value) + unitOf(report);
    if (report.result.status == SearchStatus::found) {
        figures +=
            "  (computed minus theory: " + figureOf(report, report.result.answer - report.theory->value) +
            ")";
    }
    return line("theory", figures) + line("", report.theory->prediction.formula);
}

/// Where the answer exceeds its bound, the reason; a larger excess has a warning.
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

ResultLines upperBoundText(const SearchReport& report) {
    const Ceiling& bound = report.result.upper_bound;
    return line("upper bound", bound.value ? figureOf(report, *bound.value) + unitOf(report) +
                                                 "  (limit analysis, joints that open as they slide" +
                                                 aboveText(report) + ")"
                                           : "none: " + bound.reason);
}

ResultLines intervalReasons(const SearchReport& report) {
    const auto& [low, high] = report.result.answer_interval_reasons;
    if (!report.result.answer_interval) return {};
    return line("interval", "low: " + low) + line("", "high: " + high);
}

/// The answers by other failure displacements, where they differ.
ResultLines displacementText(const SearchReport& report) {
    std::string answers;
    for (const DisplacementAnswer& other : report.result.answers_by_displacement) {
        answers += (answers.empty() ? "" : ", ") + scientific(other.displacement) + ": " +
                   figureOf(report, other.load);
    }
    if (answers.empty()) return {};
    return line("by displacement", answers +
                                       "  (answers for other failure displacements, as shares of a block; "
                                       "here " +
                                       scientific(report.result.failure_displacement) + ")");
}

ResultLines cohesionText(const SearchReport& report) {
    const std::optional<double>& kept = report.result.kept_cohesion;
    if (!kept) return {};
    return line("cohesion kept",
                figureOf(report, *kept) + unitOf(report) +
                    "  (the answer if joints kept it as they slip, as in limit equilibrium)");
}

ResultLines couplingLine(const SearchResult& result) {
    if (!result.flow_coupling) return {};
    return line("coupled flow", couplingText(*result.flow_coupling));
}

std::string movingText(const SearchResult& result) {
    if (result.moving_blocks.empty()) return "none";
    const std::string of =
        result.motions.empty() ? "" : " of " + std::to_string(result.motions.size()) + " free";
    return std::to_string(result.moving_blocks.size()) + of + ": " + compactNames(result.moving_blocks);
}

ResultLines amountLine(const SearchReport& report) {
    const SearchResult& result = report.result;
    if (result.moving_blocks.empty()) return {};
    return line("failing volume", amountText(result.failing_volume, result.failing_mass) + ", " +
                                      percentText(massShare(report.scenario.model, result.moving_blocks)) +
                                      " of the free blocks' mass");
}

/// A remark on an answer of a small part of the slope, and how to search for the rest.
ResultLines smallPartText(const SearchReport& report) {
    constexpr double kSmall = 0.05;
    const double share = massShare(report.scenario.model, report.result.moving_blocks);
    if (!report.search.follows_groups || report.result.groups.size() > 1 || !(share > 0 && share < kSmall))
        return {};
    return line("", "these have " + percentText(share) +
                        " of the free blocks' mass; --groups 4 finds the groups that fail next; "
                        "analysis.least_mass_share removes such small groups before the answer");
}

ResultLines fallenText(const SearchResult& result) {
    if (result.fallen_at_start.empty()) return {};
    return line("fallen at start",
                std::to_string(result.fallen_at_start.size()) + ": " + compactNames(result.fallen_at_start));
}

std::string betweenText(const SearchReport& report, const BlockGroup& group) {
    if (group.low == group.high) return "at " + figureOf(report, group.factor) + unitOf(report);
    return "between " + figureOf(report, group.low) + " and " + figureOf(report, group.high) + unitOf(report);
}

/// Failures below the answer that were too small to be it.
ResultLines removedText(const SearchReport& report) {
    ResultLines rows;
    for (const BlockGroup& group : report.result.removed_groups) {
        const std::string share = percentText(massShare(report.scenario.model, group.blocks));
        const char* what = rows.empty() ? "removed before" : "";
        rows = std::move(rows) +
               line(what, betweenText(report, group) + ": " + std::to_string(group.blocks.size()) + " with " +
                              share + " of the mass, " + amountText(group.volume, group.mass) + ": " +
                              compactNames(group.blocks));
    }
    return rows;
}

/// The groups after the first, which is the answer.
ResultLines groupsText(const SearchResult& result) {
    ResultLines rows;
    for (std::size_t k = 1; k < result.groups.size(); ++k) {
        const BlockGroup& group = result.groups[k];
        rows = std::move(rows) +
               line("then fail", "at " + text(group.factor, 4) + ": " + amountText(group.volume, group.mass) +
                                     ": " + compactNames(group.blocks));
    }
    return rows;
}

}  // namespace

bool wasInterrupted(const SearchResult& result) {
    // A probe that was cut short is undecided, too.
    return result.status == SearchStatus::interrupted ||
           (result.status == SearchStatus::undecided && stopRequested());
}

std::string figureOf(const SearchReport& report, double load) {
    return loadFigure(report.search, load, report.search.load->decimals);
}

std::string unitOf(const SearchReport& report) {
    return *report.search.load->unit == '\0' ? "" : " " + std::string(report.search.load->unit);
}

std::string percentText(double share) {
    constexpr double kLeastTold = 1e-4;
    return (share < kLeastTold ? "less than 0.01" : text(100 * share, share < 0.01 ? 2 : 1)) + " %";
}

std::string scientific(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.1e", value);
    return buffer;
}

std::string amountText(double volume, double mass) {
    constexpr double kKilogramsInTonne = 1000;
    char words[64];
    std::snprintf(words, sizeof words, "%.4g m3, %.4g t", volume, mass / kKilogramsInTonne);
    return words;
}

ResultLines answerLines(const SearchReport& report) { return line(report.search.answer, answerText(report)); }

ResultLines besideLines(const SearchReport& report) {
    return theoryText(report) + upperBoundText(report) + cohesionText(report) + couplingLine(report.result);
}

ResultLines intervalLines(const SearchReport& report) {
    return intervalReasons(report) + displacementText(report);
}

ResultLines failureLines(const SearchReport& report) {
    const SearchResult& result = report.result;
    return line("failure mode", toString(result.mode)) + line("moving blocks", movingText(result)) +
           amountLine(report) + smallPartText(report);
}

ResultLines groupLines(const SearchReport& report) {
    return fallenText(report.result) + removedText(report) + groupsText(report.result);
}

ResultLines supportLines(const SearchReport& report) {
    ResultLines rows;
    for (const SupportTexts& kind : supportTexts(report.result.supports)) {
        for (const std::string& each : kind.lines)
            rows.push_back({&each == &kind.lines.front() ? kind.kind : "", each});
    }
    return rows;
}

}  // namespace talus::tools
