#include "reproduction/results.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "cli/block_names.h"
#include "cli/text.h"

namespace talus::tools {
namespace {

/// "3", "1-3", or "1-2, 5" for gaps.
std::string rangesText(const std::set<int>& numbers) {
    std::string text;
    for (auto first = numbers.begin(); first != numbers.end();) {
        auto last = first;
        while (std::next(last) != numbers.end() && *std::next(last) == *last + 1) ++last;
        if (!text.empty()) text += ", ";
        text += std::to_string(*first);
        if (*last != *first) text += "-" + std::to_string(*last);
        first = std::next(last);
    }
    return text;
}

std::string plural(const std::string& noun, const std::set<int>& numbers) {
    return noun + (numbers.size() == 1 ? " " : "s ") + rangesText(numbers);
}

std::optional<double> difference(std::optional<double> a, std::optional<double> b) {
    if (!a || !b) return std::nullopt;
    return *a - *b;
}

}  // namespace

const char* groupName(PaperGroup group) {
    switch (group) {
        case PaperGroup::table:
            return "table-1";
        case PaperGroup::section5:
            return "section-5";
        case PaperGroup::points:
            return "lp-study";
        case PaperGroup::quarter_water:
            return "quarter-water";
    }
    return "";
}

std::string groupTitle(PaperGroup group) {
    switch (group) {
        case PaperGroup::table:
            return "Table 1";
        case PaperGroup::section5:
            return "Section 5";
        case PaperGroup::points:
            return "Contact points";
        case PaperGroup::quarter_water:
            return "Quarter points, water";
    }
    return "";
}

std::string label(const PaperCase& what) {
    if (what.group == PaperGroup::points) return "dry, " + what.points;
    if (what.fissures.empty()) return "dry";
    const std::set<int> numbers(what.fissures.begin(), what.fissures.end());
    return plural("fissure", numbers);
}

std::string fileName(const PaperCase& what) {
    return what.group == PaperGroup::table ? what.name + "-phi-" + text(what.friction_deg, 1) : what.name;
}

std::string statusText(const PaperRun& run) {
    if (!run.errors.empty()) return "failed";
    if (!run.begun) return "not_run";
    // The engine calls it "undecided", which here would read like a finding.
    if (run.search.status == SearchStatus::interrupted) return "interrupted";
    return talus::toString(run.search.status);
}

std::optional<double> criticalDeg(const PaperRun& run) {
    if (statusText(run) != "found") return std::nullopt;
    return degrees(run.search.answer);
}

std::optional<double> theoryDeg(const PaperRun& run) {
    if (!run.what.theory) return std::nullopt;
    return degrees(run.what.theory->critical_tilt);
}

std::optional<double> lessTheory(const PaperRun& run) { return difference(criticalDeg(run), theoryDeg(run)); }
std::optional<double> lessPaper(const PaperRun& run) {
    return difference(criticalDeg(run), run.what.paper_deg);
}

std::string failureText(const PaperRun& run) {
    return criticalDeg(run) ? talus::toString(run.search.mode) : std::string();
}

std::string movingText(const PaperRun& run) {
    return criticalDeg(run) ? columnsText(run.search.moving_blocks, run.what.scenario.model.stack) : "";
}

std::string columnsText(const std::vector<std::string>& blocks, const std::optional<StackShape>& stack) {
    std::set<int> columns, rows;
    for (const std::string& block : blocks) {
        if (const auto place = stackName(block)) {
            columns.insert(place->column);
            rows.insert(place->row);
        }
    }
    if (columns.empty()) return "none";
    const bool all_rows = stack && rows.size() == static_cast<std::size_t>(stack->rows);
    return plural("column", columns) + (all_rows ? "" : ", " + plural("row", rows)) + " (" +
           std::to_string(blocks.size()) + (blocks.size() == 1 ? " block)" : " blocks)");
}

std::string answerText(const PaperRun& run) {
    const auto angle = criticalDeg(run);
    return label(run.what) + " phi " + text(run.what.friction_deg, 1) + ": " +
           (angle ? text(*angle, 2) : statusText(run));
}

std::optional<double> fissureDistance(const PaperCase& what) {
    const auto& stack = what.scenario.model.stack;
    if (what.fissures.empty() || !stack) return std::nullopt;
    return *std::min_element(what.fissures.begin(), what.fissures.end()) * stack->block.x();
}

std::optional<double> distanceOverDepth(const PaperCase& what) {
    const auto distance = fissureDistance(what);
    if (!distance || what.water_depth <= 0) return std::nullopt;
    return *distance / what.water_depth;
}

std::vector<const PaperRun*> runsOf(const PaperResults& results, PaperGroup group) {
    std::vector<const PaperRun*> runs;
    for (const PaperRun& run : results.runs) {
        if (run.what.group == group) runs.push_back(&run);
    }
    return runs;
}

const PaperRun* tableRun(const PaperResults& results, int fissure, double friction_deg) {
    const std::vector<int> fissures = fissure == 0 ? std::vector<int>{} : std::vector<int>{fissure};
    for (const PaperRun* run : runsOf(results, PaperGroup::table)) {
        if (run->what.fissures == fissures && run->what.friction_deg == friction_deg) return run;
    }
    return nullptr;
}

const PaperRun* pointsRun(const PaperResults& results, const std::string& points) {
    for (const PaperRun* run : runsOf(results, PaperGroup::points)) {
        if (run->what.points == points) return run;
    }
    return nullptr;
}

std::vector<GroupCost> groupCosts(const PaperResults& results) {
    std::vector<GroupCost> costs;
    for (const PaperGroup group :
         {PaperGroup::table, PaperGroup::section5, PaperGroup::points, PaperGroup::quarter_water}) {
        GroupCost cost{group};
        for (const PaperRun* run : runsOf(results, group)) {
            if (!run->begun) continue;
            ++cost.cases;
            cost.cpu_seconds += run->cpu_seconds;
            cost.steps += run->search.steps;
        }
        if (cost.cases > 0) costs.push_back(cost);
    }
    std::stable_sort(costs.begin(), costs.end(),
                     [](const GroupCost& a, const GroupCost& b) { return a.cpu_seconds > b.cpu_seconds; });
    return costs;
}

std::vector<const PaperRun*> costliest(const PaperResults& results, std::size_t count) {
    std::vector<const PaperRun*> runs;
    for (const PaperRun& run : results.runs) {
        if (run.begun) runs.push_back(&run);
    }
    std::stable_sort(runs.begin(), runs.end(),
                     [](const PaperRun* a, const PaperRun* b) { return a->cpu_seconds > b->cpu_seconds; });
    runs.resize(std::min(count, runs.size()));
    return runs;
}

std::optional<double> largest(const std::vector<std::optional<double>>& values) {
    std::optional<double> found;
    for (const auto& value : values) {
        if (value && (!found || std::abs(*value) > std::abs(*found))) found = value;
    }
    return found;
}

}  // namespace talus::tools
