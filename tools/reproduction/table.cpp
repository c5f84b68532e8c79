#include "reproduction/table.h"

#include <algorithm>

#include "cli/text.h"
#include "reproduction/laboratory.h"
#include "talus/formats/scenario.h"

namespace talus::tools {
namespace {

using Row = std::vector<std::string>;

bool isNumber(const std::string& cell) {
    return !cell.empty() && cell.find_first_not_of("+-.0123456789") == std::string::npos;
}

std::vector<std::size_t> widths(const std::vector<Row>& rows) {
    std::vector<std::size_t> widest;
    for (const Row& row : rows) {
        widest.resize(std::max(widest.size(), row.size()), 0);
        for (std::size_t i = 0; i < row.size(); ++i) widest[i] = std::max(widest[i], row[i].size());
    }
    return widest;
}

/// A column stands right when its first filled cell below the head is a number.
std::vector<bool> standRight(const std::vector<Row>& rows, std::size_t columns) {
    std::vector<bool> right(columns, false);
    for (std::size_t i = 0; i < columns; ++i) {
        for (std::size_t row = 1; row < rows.size(); ++row) {
            if (i >= rows[row].size() || rows[row][i].empty() || rows[row][i] == "-") continue;
            right[i] = isNumber(rows[row][i]);
            break;
        }
    }
    return right;
}

std::string trimmedRight(std::string line) {
    line.erase(line.find_last_not_of(' ') + 1);
    return line;
}

Row tableHead() {
    return {"case", "L/H",       "lab.",     "DEM 18",   "19.5",          "21", "exact 18", "19.5",
            "21",   "DEM-exact", "DEM-lab.", "fails by", "moving at 19.5"};
}

Row tableRow(const PaperResults& results, const LaboratorySeries& series) {
    Row dem, exact;
    std::vector<std::optional<double>> differences;
    for (const double friction : kPaperFrictionDeg) {
        const PaperRun* run = tableRun(results, series.fissure, friction);
        dem.push_back(shown(run ? criticalDeg(*run) : std::nullopt, 2));
        exact.push_back(shown(run ? theoryDeg(*run) : std::nullopt, 2));
        differences.push_back(run ? lessTheory(*run) : std::nullopt);
    }
    const PaperRun* middle = tableRun(results, series.fissure, kTableFrictionDeg);
    Row row{middle ? label(middle->what) : "",
            shown(middle ? distanceOverDepth(middle->what) : std::nullopt, 2), text(series.average_deg, 1)};
    row.insert(row.end(), dem.begin(), dem.end());
    row.insert(row.end(), exact.begin(), exact.end());
    row.push_back(shownSigned(largest(differences), 3));
    row.push_back(shownSigned(middle ? lessPaper(*middle) : std::nullopt, 2));
    row.push_back(middle ? failureText(*middle) : "");
    row.push_back(middle ? movingText(*middle) : "");
    return row;
}

std::string tableSection(const PaperResults& results) {
    std::vector<Row> rows{tableHead()};
    for (const LaboratorySeries& series : kLaboratory) rows.push_back(tableRow(results, series));
    return "Table 1: critical angle in deg, friction angle 18, 19.5 and 21 deg, \"" + results.table_points +
           "\" points\n" + alignedTable(rows, "  ") +
           "  lab.: average of three tests; exact: limit equilibrium; DEM-exact: largest of the three; "
           "DEM-lab.: at 19.5.\n";
}

std::string section5(const PaperResults& results) {
    std::vector<Row> rows{
        {"case", "L/H", "paper's DEM", "DEM", "exact", "DEM-exact", "DEM-paper", "fails by", "moving"}};
    for (const PaperRun* run : runsOf(results, PaperGroup::section5)) {
        rows.push_back({label(run->what), shown(distanceOverDepth(run->what), 2),
                        shown(run->what.paper_deg, 1), shown(criticalDeg(*run), 2), shown(theoryDeg(*run), 2),
                        shownSigned(lessTheory(*run), 3), shownSigned(lessPaper(*run), 2), failureText(*run),
                        movingText(*run)});
    }
    return "Section 5: twelve columns, friction angle 19.5 deg\n" + alignedTable(rows, "  ") +
           "  Equal levels on both walls of a column cancel, so water in fissures 8-10 adds nothing to "
           "fissure 7.\n";
}

std::string pointsSection(const PaperResults& results) {
    std::vector<Row> rows{{"points", "DEM", "exact", "DEM-exact", "fails by"}};
    for (const PaperRun* run : runsOf(results, PaperGroup::points)) {
        rows.push_back({run->what.points, shown(criticalDeg(*run), 2), shown(theoryDeg(*run), 2),
                        shownSigned(lessTheory(*run), 2), failureText(*run)});
    }
    return "Contact points: dry slope, one slice, friction angle 19.5 deg\n" + alignedTable(rows, "  ");
}

std::string quarterSection(const PaperResults& results) {
    std::vector<Row> rows{
        {"case", "lab.", "DEM quarter", "DEM " + results.table_points, "exact", "fails by"}};
    for (const PaperRun* run : runsOf(results, PaperGroup::quarter_water)) {
        const int fissure = run->what.fissures.front();
        const PaperRun* whole = tableRun(results, fissure, kTableFrictionDeg);
        rows.push_back({label(run->what), text(kLaboratory[static_cast<std::size_t>(fissure)].average_deg, 1),
                        shown(criticalDeg(*run), 2), shown(whole ? criticalDeg(*whole) : std::nullopt, 2),
                        shown(theoryDeg(*run), 2), failureText(*run)});
    }
    return "The paper's \"quarter\" points with water: one slice, friction angle 19.5 deg\n" +
           alignedTable(rows, "  ");
}

/// Cases without an answer, one line each.
std::string unanswered(const PaperResults& results) {
    std::string lines;
    for (const PaperRun& run : results.runs) {
        if (criticalDeg(run)) continue;
        lines += "  " + run.what.name + ", phi " + text(run.what.friction_deg, 1) + ": " + statusText(run);
        if (!run.errors.empty()) lines += ": " + formats::format(run.errors.front());
        lines += '\n';
    }
    return lines.empty() ? "" : "Without an answer\n" + lines + '\n';
}

std::string timing(const PaperResults& results) {
    std::vector<Row> rows{{"group", "cases", "CPU s", "million steps", "us per step"}};
    double cpu = 0;
    for (const GroupCost& cost : groupCosts(results)) {
        cpu += cost.cpu_seconds;
        const auto steps = static_cast<double>(cost.steps);
        rows.push_back({groupTitle(cost.group), std::to_string(cost.cases), text(cost.cpu_seconds, 1),
                        text(1e-6 * steps, 2), steps > 0 ? text(1e6 * cost.cpu_seconds / steps, 1) : "-"});
    }
    std::string slowest;
    for (const PaperRun* run : costliest(results, 3)) {
        slowest += (slowest.empty() ? "" : ", ") + run->what.name + " phi " +
                   text(run->what.friction_deg, 1) + " " + text(run->cpu_seconds, 1) + " s";
    }
    return "Where the time went\n" + alignedTable(rows, "  ") + "  costliest: " + slowest + "\n  " +
           text(cpu, 1) + " CPU s in " + text(results.wall_seconds, 1) + " s on " +
           std::to_string(results.threads) + (results.threads == 1 ? " thread\n" : " threads\n");
}

}  // namespace

std::string alignedTable(const std::vector<Row>& rows, const std::string& indent) {
    const std::vector<std::size_t> width = widths(rows);
    const std::vector<bool> right = standRight(rows, width.size());
    std::string table;
    for (const Row& row : rows) {
        std::string line = indent;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string space(width[i] - row[i].size(), ' ');
            line += (i > 0 ? "  " : "") + (right[i] ? space + row[i] : row[i] + space);
        }
        table += trimmedRight(line) + '\n';
    }
    return table;
}

std::string terminalTable(const PaperResults& results) {
    const std::string head = results.interrupted ? "Interrupted: only finished cases are shown.\n\n" : "";
    return head + tableSection(results) + '\n' + section5(results) + '\n' + pointsSection(results) + '\n' +
           quarterSection(results) + '\n' + unanswered(results) + timing(results);
}

}  // namespace talus::tools
