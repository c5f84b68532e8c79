#include "reproduction/page.h"

#include "report/html.h"
#include "report/page_style.h"
#include "reproduction/kept.h"
#include "reproduction/laboratory.h"
#include "reproduction/notes.h"
#include "reproduction/page_parameters.h"
#include "reproduction/page_tables.h"
#include "reproduction/plots.h"
#include "reproduction/slope.h"

namespace talus::tools {
namespace {

using namespace html;

// --- drawings ----------------------------------------------------------------------------------------------

std::string slopeFigure(const PaperRun& run, const std::string& title, const std::string& beside) {
    std::string caption = "<strong>" + escaped(title) + "</strong>: ";
    const auto angle = criticalDeg(run);
    caption += angle ? "fails at " + text(*angle, 2) + "\u00b0 by " + failureText(run) + "; " +
                           "<span class=\"whole\">" + escaped(movingText(run)) + "</span>."
                     : "no answer (" + statusText(run) + "), drawn at the exact limit.";
    if (theoryDeg(run))
        caption += " Exact limit " + shown(theoryDeg(run), 2) + "\u00b0" + escaped(beside) + ".";
    return tagged("figure", drawSlope(run).inlined() + tagged("figcaption", caption));
}

std::string besideText(const PaperRun& run) {
    if (!run.what.paper_deg) return "";
    const char* source = run.what.group == PaperGroup::section5 ? ", the paper's DEM " : ", laboratory ";
    return source + text(*run.what.paper_deg, 1) + "\u00b0";
}

std::string slopeLegend() {
    std::string entries;
    for (const auto& [name, role] : kSlopeColours) {
        const std::string swatch =
            "<svg viewBox=\"0 0 24 14\" aria-hidden=\"true\"><rect x=\"1\" y=\"1\" width=\"22\" "
            "height=\"12\" " +
            classed(role) + "/></svg>";
        entries += tagged("li", swatch + escaped(name));
    }
    return tagged("ul", entries, classed("key"));
}

std::string slopes(const PaperResults& results) {
    std::string figures;
    for (const LaboratorySeries& series : kLaboratory) {
        const PaperRun* run = tableRun(results, series.fissure, kTableFrictionDeg);
        if (run) figures += slopeFigure(*run, label(run->what), besideText(*run));
    }
    for (const PaperRun* run : runsOf(results, PaperGroup::section5)) {
        figures += slopeFigure(*run, "Twelve columns, " + label(run->what), besideText(*run));
    }
    return heading("slopes", "The slope at failure") +
           paragraph(
               "Friction angle 19.5\u00b0, each slope at the tilt at which it fails. Moving blocks are "
               "shifted the way they moved, enlarged; the gap that opens shows the watered fissure. The "
               "first of three slices is drawn.") +
           slopeLegend() + tagged("div", figures, classed("slopes"));
}

// --- tables and plots --------------------------------------------------------------------------------------

std::string tableSection(const PaperResults& results) {
    return heading("table", "Table 1") + htmlTable1(results) +
           paragraph(
               "L/H: distance of the fissure from the toe over the water depth of 0.35 m. Exact limit: "
               "limit equilibrium of the mass in front of the fissure, tan\u00a0\u03b2 = tan\u00a0\u03c6 "
               "\u2212 \u03c1w\u00a0H\u00b2 / (2\u00a0\u03c1\u00a0L\u00a0h). \u03c6 from laboratory: the "
               "friction angle at which the exact limit gives the laboratory's average; 18\u00b0 to "
               "21\u00b0 was measured on the joints. Failure at \u03c6 = 19.5\u00b0. The three slices "
               "make 105 blocks.",
               "muted");
}

std::string plots(const PaperResults& results) {
    return heading("fig6", "Critical angle against L/H (the paper\u2019s Fig. 6)") +
           wide(plotFig6(results).inlined()) + tagged("h3", "Difference from the exact limit") +
           paragraph(
               "The search ends with a bracket between the last tilt that held and the first that did "
               "not; the answer is its middle.") +
           wide(plotDifference(results).inlined());
}

std::string section5(const PaperResults& results) {
    return heading("section5", "Section 5: fissures far from the toe") + htmlSection5(results);
}

std::string pointsPair(const PaperResults& results) {
    std::string figures;
    for (const char* rule : {"quarter", "vertex"}) {
        if (const PaperRun* run = pointsRun(results, rule))
            figures += slopeFigure(*run, std::string(rule) + " points", "");
    }
    return tagged("div", figures, classed("slopes pair"));
}

std::string points(const PaperResults& results) {
    return heading("points", "Contact points") +
           paragraph(
               "How many contact points an interface has, and where, decides about which line a block "
               "can turn. The paper\u2019s rule (quarter: four points at the centres of four equal "
               "areas) puts that line inside the block. Computed on one slice, friction angle "
               "19.5\u00b0.") +
           wide(plotPoints(results).inlined()) + pointsPair(results) + htmlDryPoints(results) +
           htmlQuarterWater(results);
}

// --- words -------------------------------------------------------------------------------------------------

std::string notes(const std::vector<Note>& list) {
    std::string html;
    for (const Note& note : list) html += tagged("h3", escaped(note.title)) + paragraph(note.text);
    return html;
}

std::string plainText(const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string provenanceList(const PaperResults& results) {
    std::string list;
    for (const auto& [key, value] : results.provenance.items()) {
        if (value.is_null()) continue;
        std::string term = key;
        for (char& letter : term) letter = letter == '_' ? ' ' : letter;
        list += definition(term, plainText(value));
    }
    return tagged("dl", list);
}

std::string timing(const PaperResults& results) {
    std::string slowest;
    for (const PaperRun* run : costliest(results, 5)) {
        slowest += (slowest.empty() ? "Costliest: " : "; ") + run->what.name + ", \u03c6 " +
                   text(run->what.friction_deg, 1) + "\u00b0, " + text(run->cpu_seconds, 1) + " s";
    }
    return heading("time", "Time and provenance") + htmlCosts(results) +
           paragraph(slowest + ". Wall time " + text(results.wall_seconds, 1) + " s on " +
                     std::to_string(results.threads) + (results.threads == 1 ? " thread." : " threads.")) +
           provenanceList(results);
}

/// The scenarios at Table 2's friction angle; the other friction angles differ in that one number.
std::string scenarios(const PaperResults& results) {
    std::string html = paragraph(
        "Each case is a scenario file, written beside this page under scenarios/; \u201ctalus "
        "critical-angle FILE\u201d computes one again. Those at friction angle 19.5\u00b0, the other two "
        "differ in that number only:");
    for (const PaperRun& run : results.runs) {
        const bool whole = run.what.group == PaperGroup::table || run.what.group == PaperGroup::section5;
        if (!whole || run.what.friction_deg != kTableFrictionDeg) continue;
        html += tagged("details", tagged("summary", escaped(fileName(run.what) + ".toml")) +
                                      tagged("pre", escaped(run.what.scenario.text)));
    }
    return heading("scenarios", "Scenario files") + html;
}

std::string styleSheet() {
    return "<style>" + std::string(kPageStyle) + drawingStyle(lightPalette(), "svg ") +
           "@media screen and (prefers-color-scheme:dark){\n" + drawingStyle(darkPalette(), "svg ") +
           "}\n</style>\n";
}

std::string contents(bool has_scatter) {
    std::string links;
    for (const auto& [id, name] : {std::pair{"slopes", "Slopes"},
                                   {"replays", "Replays"},
                                   {"table", "Table 1"},
                                   {"fig6", "Fig. 6"},
                                   {"section5", "Section 5"},
                                   {"scatter", "Scatter"},
                                   {"points", "Contact points"},
                                   {"differences", "Differences"},
                                   {"errata", "Errata"},
                                   {"parameters", "Parameters"},
                                   {"time", "Time"},
                                   {"scenarios", "Scenarios"}}) {
        if (!has_scatter && name == std::string("Scatter")) continue;
        links += "<a href=\"#" + std::string(id) + "\">" + name + "</a> ";
    }
    return tagged("nav", links, "aria-label=\"Contents\"");
}

std::string opening(const PaperResults& results) {
    std::string html = tagged("h1", "Water in a fissure and the tilt at which a slope of blocks fails") +
                       paragraph(mainResult(results), "lead");
    if (results.interrupted)
        html += paragraph("Interrupted: only the cases finished until then are shown.", "alert");
    html += paragraph(
        "A slope of loose blocks on a floor is tilted until it fails, dry and with water in one vertical "
        "fissure: the laboratory test of a paper on fissure water pressure in vertical sliding surfaces, "
        "computed again with rigid blocks (discrete element method, DEM) and set beside the laboratory "
        "and the closed formula.");
    return html + contents(results.scatter.has_value());
}

}  // namespace

std::string paperPage(const PaperResults& results) {
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta "
           "name=\"color-scheme\" content=\"light dark\">\n<title>Talus: fissure water and the critical "
           "angle</title>\n" +
           styleSheet() + "</head>\n<body>\n" + tagged("header", opening(results)) + "<main>\n" +
           slopes(results) + htmlKept(results) + tableSection(results) + plots(results) + section5(results) +
           (results.scatter ? htmlScatter(*results.scatter) : "") + points(results) +
           heading("differences", "Where laboratory, paper and model differ") +
           notes(differenceNotes(results)) + heading("errata", "Slips in the paper\u2019s print") +
           notes(errata()) + htmlParameters(results) + timing(results) + scenarios(results) +
           "</main>\n</body>\n</html>\n";
}

}  // namespace talus::tools
