#include "reproduction/page.h"

#include "cli/json.h"
#include "cli/text.h"
#include "report/page.h"
#include "reproduction/bag_page.h"
#include "reproduction/kept.h"
#include "reproduction/laboratory.h"
#include "reproduction/notes.h"
#include "reproduction/plots.h"
#include "reproduction/slope.h"

namespace talus::tools {
namespace {

// --- drawings
// -------------------------------------------------------------------------------------------------------

Drawing slopeFigure(const PaperRun& run, const std::string& title, const std::string& beside) {
    Drawing drawing = drawSlope(run);
    drawing.caption_title = title;
    const auto angle = criticalDeg(run);
    drawing.caption =
        angle ? "fails at " + text(*angle, 2) + "\u00b0 by " + failureText(run) + "; " + movingText(run) + "."
              : "no answer (" + statusText(run) + "), drawn at the exact limit.";
    if (theoryDeg(run))
        drawing.caption += " Exact limit " + shown(theoryDeg(run), 2) + "\u00b0" + beside + ".";
    return drawing;
}

std::string besideText(const PaperRun& run) {
    if (!run.what.paper_deg) return "";
    const char* source = run.what.group == PaperGroup::section5 ? ", the paper\u2019s DEM " : ", laboratory ";
    return source + text(*run.what.paper_deg, 1) + "\u00b0";
}

Json slopes(const PaperResults& results) {
    std::vector<Drawing> figures;
    for (const LaboratorySeries& series : kLaboratory) {
        const PaperRun* run = tableRun(results, series.fissure, kTableFrictionDeg);
        if (run) figures.push_back(slopeFigure(*run, label(run->what), besideText(*run)));
    }
    for (const PaperRun* run : runsOf(results, PaperGroup::section5))
        figures.push_back(slopeFigure(*run, "Twelve columns, " + label(run->what), besideText(*run)));
    return section("slopes", "Slopes", "The slope at failure",
                   {paragraph("Each slope at the tilt at which it fails, for a friction angle of 19.5\u00b0. "
                              "Moving blocks are drawn with enlarged displacements; the open gap shows the "
                              "watered fissure. Only the first of three slices is drawn."),
                    drawings(figures, false, slopeColours())});
}

// --- tables and plots
// -----------------------------------------------------------------------------------------------

Json tableSection(const PaperResults& results) {
    return section(
        "table", "Table 1", "Table 1",
        {table1(results),
         paragraph(
             "L/H: distance of the fissure from the toe over the water depth of 0.35 m. Exact limit: limit "
             "equilibrium of the mass in front of the fissure, tan\u00a0\u03b2 = tan\u00a0\u03c6 \u2212 "
             "\u03c1w\u00a0H\u00b2 / (2\u00a0\u03c1\u00a0L\u00a0h). \u03c6 from laboratory: the friction "
             "angle at which the exact limit gives the laboratory\u2019s average; 18\u00b0 to 21\u00b0 was "
             "measured on the joints. Failure at \u03c6 = 19.5\u00b0. The three slices make 105 blocks.",
             "muted")});
}

Json plots(const PaperResults& results) {
    return section("fig6", "Fig. 6", "Critical angle against L/H (the paper\u2019s Fig. 6)",
                   {toJson(plotFig6(results)), toJson(plotDifference(results))});
}

Json section5(const PaperResults& results) {
    return section("section5", "Section 5", "Section 5: fissures far from the toe",
                   Json::array({section5Table(results)}));
}

Json points(const PaperResults& results) {
    std::vector<Drawing> pair;
    for (const char* rule : {"quarter", "vertex"}) {
        if (const PaperRun* run = pointsRun(results, rule))
            pair.push_back(slopeFigure(*run, std::string(rule) + " points", ""));
    }
    return section(
        "points", "Contact points", "Contact points",
        {paragraph(
             "How many contact points an interface has, and where, decides about which line a block can "
             "turn. The paper\u2019s rule (quarter: four points at the centres of four equal areas) puts "
             "that "
             "line inside the block. Computed on one slice, friction angle 19.5\u00b0."),
         toJson(plotPoints(results)), drawings(pair, true), dryPointsTable(results),
         quarterWaterTable(results)});
}

// --- words
// ----------------------------------------------------------------------------------------------------------

Json notes(const std::string& id, const std::string& nav, const std::string& title,
           const std::vector<Note>& list) {
    Json blocks = Json::array();
    for (const Note& note : list) {
        blocks.push_back(subheading(note.title));
        blocks.push_back(paragraph(note.text));
    }
    return section(id, nav, title, std::move(blocks));
}

Json parameterSection(const PaperResults& results) {
    return section(
        "parameters", "Parameters", "What was computed",
        {facts(parameters(results)),
         paragraph("A case fails if neighbouring blocks part by more than the failure displacement before "
                   "they reach a new equilibrium. The verdict does not depend on a fixed time.")});
}

Json timing(const PaperResults& results) {
    std::string slowest;
    for (const PaperRun* run : costliest(results, 5)) {
        slowest += (slowest.empty() ? "Costliest: " : "; ") + run->what.name + ", \u03c6 " +
                   text(run->what.friction_deg, 1) + "\u00b0, " + text(run->cpu_seconds, 1) + " s";
    }
    return section(
        "time", "Time", "Time and provenance",
        {costsTable(results),
         paragraph(slowest + ". Wall time " + text(results.wall_seconds, 1) + " s on " +
                   std::to_string(results.threads) + (results.threads == 1 ? " thread." : " threads.")),
         facts(provenanceFacts(results.provenance))});
}

/// The scenarios at Table 2's friction angle; the other friction angles differ in that one number.
Json scenarios(const PaperResults& results) {
    Json blocks = Json::array(
        {paragraph("Each case is a scenario file in scenarios/ beside this page; \u201ctalus critical-angle "
                   "FILE\u201d recomputes it. The files for a friction angle of 19.5\u00b0 are listed here; "
                   "those for the other two angles differ only in that number:")});
    for (const PaperRun& run : results.runs) {
        const bool whole = run.what.group == PaperGroup::table || run.what.group == PaperGroup::section5;
        if (whole && run.what.friction_deg == kTableFrictionDeg)
            blocks.push_back(file(fileName(run.what) + ".toml", run.what.scenario.text));
    }
    return section("scenarios", "Scenarios", "Scenario files", std::move(blocks));
}

Json opening(const PaperResults& results) {
    Json blocks = Json::array({paragraph(mainResult(results), "lead")});
    if (results.interrupted)
        blocks.push_back(paragraph("Interrupted: the page shows the cases finished before that.", "alert"));
    blocks.push_back(
        paragraph("A slope of loose blocks on a floor is tilted until it fails, dry and with water in one "
                  "vertical fissure. This is the laboratory test of a paper on fissure water pressure in "
                  "vertical sliding surfaces. It is recomputed with rigid blocks (discrete element method, "
                  "DEM) and compared with the laboratory and the closed formula."));
    return blocks;
}

}  // namespace

Json paperReport(const PaperResults& results) {
    Report report;
    report.title = "Talus: fissure water and the critical angle";
    report.heading = "Water in a fissure and the tilt at which a slope of blocks fails";
    report.opening = opening(results);
    report.provenance = results.provenance;
    report.sections = {slopes(results),       keptSection(results), bagSection(results),
                       tableSection(results), plots(results),       section5(results)};
    if (results.scatter) report.sections.push_back(scatterSection(*results.scatter));
    report.sections.push_back(points(results));
    report.sections.push_back(notes("differences", "Differences", "Where laboratory, paper and model differ",
                                    differenceNotes(results)));
    report.sections.push_back(notes("errata", "Errata", "Misprints in the paper", errata()));
    if (!results.runs.empty()) report.sections.push_back(parameterSection(results));
    report.sections.push_back(timing(results));
    report.sections.push_back(scenarios(results));
    return toJson(report);
}

}  // namespace talus::tools
