#include "reproduction/page_tables.h"

#include "report/html.h"
#include "reproduction/laboratory.h"
#include "reproduction/notes.h"

namespace talus::tools {
namespace {

using namespace html;

std::string tableHead() {
    std::string second;
    for (int group = 0; group < 2; ++group) {
        second += head("18", "start") + head("19.5") + head("21");
    }
    return row(head("", "words") + head("") + head("laboratory", "start", 2) +
               head("DEM, \u03c6 =", "start", 3) + head("exact limit, \u03c6 =", "start", 3) +
               head("DEM \u2212 exact", "start") + head("DEM \u2212 lab.", "start") +
               head("\u03c6 from", "start") + head("", "start")) +
           row(head("water in", "words") + head("L/H") + head("average", "start") + head("tests") + second +
               head("largest", "start") + head("\u03c6 = 19.5", "start") + head("laboratory", "start") +
               head("fails by", "words start"));
}

std::string testsText(const LaboratorySeries& series) {
    std::string list;
    for (const double repeat : series.repeats_deg) list += (list.empty() ? "" : " ") + text(repeat, 1);
    return list;
}

/// Table 1's three runs of one fissure, by friction angle.
std::vector<const PaperRun*> rowRuns(const PaperResults& results, int fissure) {
    std::vector<const PaperRun*> runs;
    for (const double friction : kPaperFrictionDeg) {
        if (const PaperRun* run = tableRun(results, fissure, friction)) runs.push_back(run);
    }
    return runs;
}

/// How it fails and what moves, or why there is no answer.
std::string failureCells(const PaperRun& run) {
    const std::string failure = criticalDeg(run) ? failureText(run) : statusText(run);
    return cell(failure, "words start") + cell(movingText(run), "words");
}

std::string tableRow(const std::vector<const PaperRun*>& runs, const LaboratorySeries& series) {
    std::string dem, exact;
    std::vector<std::optional<double>> differences;
    for (const PaperRun* run : runs) {
        const bool middle = run->what.friction_deg == kTableFrictionDeg;
        const std::string start = run == runs.front() ? "start" : "";
        dem += numberCell(criticalDeg(*run), 2, middle ? "main" : start);
        exact += numberCell(theoryDeg(*run), 2, start);
        differences.push_back(lessTheory(*run));
    }
    const PaperRun& middle = *runs[runs.size() / 2];
    return row(cell(label(middle.what), "words") + numberCell(distanceOverDepth(middle.what), 2) +
               numberCell(series.average_deg, 1, "start") + cell(testsText(series)) + dem + exact +
               signedCell(largest(differences), 3, "start") + signedCell(lessPaper(middle), 2, "start") +
               numberCell(impliedFrictionDeg(middle.what, series.average_deg), 1, "start") +
               cell(criticalDeg(middle) ? failureText(middle) : statusText(middle), "words start"));
}

std::string pointsRows(const PaperResults& results) {
    std::string rows;
    for (const PaperRun* run : runsOf(results, PaperGroup::points)) {
        rows += row(cell(run->what.points, "words") + numberCell(criticalDeg(*run), 2, "main") +
                    numberCell(theoryDeg(*run), 2) + signedCell(lessTheory(*run), 2) + failureCells(*run));
    }
    return rows;
}

std::string quarterRows(const PaperResults& results) {
    std::string rows;
    for (const PaperRun* run : runsOf(results, PaperGroup::quarter_water)) {
        const int fissure = run->what.fissures.front();
        const PaperRun* whole = tableRun(results, fissure, kTableFrictionDeg);
        rows += row(cell(label(run->what), "words") +
                    numberCell(kLaboratory[static_cast<std::size_t>(fissure)].average_deg, 1) +
                    numberCell(criticalDeg(*run), 2, "main start") +
                    cell(criticalDeg(*run) ? failureText(*run) : statusText(*run), "words") +
                    numberCell(whole ? criticalDeg(*whole) : std::nullopt, 2, "start") +
                    numberCell(theoryDeg(*run), 2));
    }
    return rows;
}

std::string costRows(const PaperResults& results) {
    std::string rows;
    for (const GroupCost& cost : groupCosts(results)) {
        const auto steps = static_cast<double>(cost.steps);
        rows += row(cell(groupTitle(cost.group), "words") + cell(std::to_string(cost.cases)) +
                    cell(text(cost.cpu_seconds, 1)) + cell(text(steps * 1e-6, 2)) +
                    cell(steps > 0 ? text(1e6 * cost.cpu_seconds / steps, 1) : "\u2013"));
    }
    return rows;
}

}  // namespace

std::string htmlTable1(const PaperResults& results) {
    std::string rows;
    for (const LaboratorySeries& series : kLaboratory) {
        const auto runs = rowRuns(results, series.fissure);
        if (!runs.empty()) rows += tableRow(runs, series);
    }
    return table("Critical angle in degrees; friction angle \u03c6 in degrees", tableHead(), rows);
}

std::string htmlSection5(const PaperResults& results) {
    std::string rows;
    for (const PaperRun* run : runsOf(results, PaperGroup::section5)) {
        rows += row(cell(label(run->what), "words") + numberCell(distanceOverDepth(run->what), 2) +
                    numberCell(run->what.paper_deg, 1, "start") + numberCell(criticalDeg(*run), 2, "main") +
                    numberCell(theoryDeg(*run), 2) + signedCell(lessTheory(*run), 3) +
                    signedCell(lessPaper(*run), 2) + failureCells(*run));
    }
    const std::string heads =
        row(head("water in", "words") + head("L/H") + head("paper\u2019s DEM", "start") + head("DEM") +
            head("exact limit") + head("DEM \u2212 exact") + head("DEM \u2212 paper") +
            head("fails by", "words start") + head("moving", "words"));
    return table("Twelve columns, friction angle 19.5\u00b0; critical angle in degrees", heads, rows);
}

std::string htmlDryPoints(const PaperResults& results) {
    const std::string heads =
        row(head("points", "words") + head("DEM") + head("exact limit") + head("DEM \u2212 exact") +
            head("fails by", "words start") + head("moving", "words"));
    return table("Dry slope: critical angle in degrees", heads, pointsRows(results));
}

std::string htmlQuarterWater(const PaperResults& results) {
    const std::string heads =
        row(head("water in", "words") + head("laboratory") + head("quarter", "start") +
            head("fails by", "words") + head(results.table_points, "start") + head("exact limit"));
    return table("Quarter points with water: critical angle in degrees", heads, quarterRows(results));
}

std::string htmlCosts(const PaperResults& results) {
    const std::string heads = row(head("group", "words") + head("cases") + head("CPU s") +
                                  head("million steps") + head("\u00b5s per step"));
    return table("Where the time went", heads, costRows(results));
}

}  // namespace talus::tools
