#include "reproduction/plots.h"

#include <algorithm>
#include <cmath>

#include "reproduction/laboratory.h"
#include "talus/theory.h"

namespace talus::tools {
namespace {

using Symbol = LegendEntry::Symbol;

/// The straight cut of Fig. 6: the ratio beyond which the paper calls the water's push negligible.
constexpr double kPaperRatio = 3.0;

constexpr int kLastGrid = 10;  ///< finest grid of the study of contact points

/// Single tests stand beside their average, which would hide them [px].
constexpr double kRepeatShift = 12;

double densityOf(const Model& model) { return model.blocks.empty() ? 0 : model.blocks.back().density; }

/// The exact limit with L as a continuous length, so that the curve passes between the fissures.
std::vector<Spot> theoryCurve(const PaperRun& sample, const Axis& x, const Axis& y) {
    const Model& model = sample.what.scenario.model;
    theory::SlidingMass mass;
    mass.height = model.stack->rows * model.stack->block.z();
    mass.density = densityOf(model);
    mass.water_density = model.waters.front().density;
    mass.water_depth = sample.what.water_depth;
    mass.friction = radians(sample.what.friction_deg);
    std::vector<Spot> spots;
    for (double ratio = x.lo; ratio <= x.hi + 1e-9; ratio += 0.002) {
        mass.length = ratio * mass.water_depth;
        const double angle = mass.length > 0 ? degrees(theory::criticalTiltSliding(mass)) : -1;
        if (angle >= y.lo && angle <= y.hi) spots.push_back({x.at(ratio), y.at(angle)});
    }
    return spots;
}

/// Area between the DEM's answers at the smallest and the largest friction angle, over the watered fissures.
std::vector<Spot> demBand(const PaperResults& results, const Axis& x, const Axis& y) {
    std::vector<Spot> lower, upper;
    for (const LaboratorySeries& series : kLaboratory) {
        const PaperRun* low = tableRun(results, series.fissure, kPaperFrictionDeg.front());
        const PaperRun* high = tableRun(results, series.fissure, kPaperFrictionDeg.back());
        if (!low || !high || !distanceOverDepth(low->what) || !criticalDeg(*low) || !criticalDeg(*high))
            continue;
        const double ratio = x.at(*distanceOverDepth(low->what));
        lower.push_back({ratio, y.at(*criticalDeg(*low))});
        upper.push_back({ratio, y.at(*criticalDeg(*high))});
    }
    lower.insert(lower.end(), upper.rbegin(), upper.rend());
    return lower;
}

void drawLaboratory(Svg& svg, const LaboratorySeries& series, double at, const Axis& y) {
    svg.circle(
        {at, y.at(series.average_deg)}, 6, "laboratory",
        "fissure " + std::to_string(series.fissure) + ", laboratory average " + text(series.average_deg, 1));
    for (const double repeat : series.repeats_deg)
        svg.circle({at - kRepeatShift, y.at(repeat)}, 1.8, "repeat");
}

void drawWatered(Svg& svg, const PaperResults& results, const Axis& x, const Axis& y) {
    for (const LaboratorySeries& series : kLaboratory) {
        const PaperRun* run = tableRun(results, series.fissure, kTableFrictionDeg);
        if (!run || !distanceOverDepth(run->what)) continue;
        const double at = x.at(*distanceOverDepth(run->what));
        svg.label({at, y.to - 7}, std::to_string(series.fissure), "middle", "small");
        if (const auto angle = criticalDeg(*run)) {
            svg.triangle({at, y.at(*angle)}, 6, "dem", answerText(*run));
        }
        drawLaboratory(svg, series, at, y);
    }
}

void drawDryLines(Svg& svg, const PaperResults& results, const Axis& x, const Axis& y) {
    const double laboratory = kLaboratory.front().average_deg;
    svg.line({x.from, y.at(laboratory)}, {x.to, y.at(laboratory)}, "dots");
    svg.label({x.from + 6, y.at(laboratory) + 15}, "dry, laboratory " + text(laboratory, 1), "start",
              "small");
    const PaperRun* dry = tableRun(results, 0, kTableFrictionDeg);
    if (!dry || !criticalDeg(*dry)) return;
    const double angle = *criticalDeg(*dry);
    svg.line({x.from, y.at(angle)}, {x.to, y.at(angle)}, "rule");
    svg.label({x.from + 6, y.at(angle) - 6}, "dry, DEM " + text(angle, 2), "start", "small");
}

void drawPaperRatio(Svg& svg, const Axis& x, const Axis& y) {
    const double at = x.at(kPaperRatio);
    svg.line({at, y.from}, {at, y.to}, "dots");
    double height = y.from - 46;
    for (const char* words : {"beyond 3 the", "paper neglects", "the water"}) {
        svg.label({at + 8, height}, words, "start", "small");
        height += 16;
    }
}

std::vector<LegendEntry> fig6Legend() {
    return {{"laboratory, average of three", Symbol::circle, "laboratory", 6},
            {"laboratory, each test (set left)", Symbol::circle, "repeat", 1.8},
            {"DEM, friction angle 19.5\u00b0", Symbol::triangle, "dem", 6},
            {"DEM, friction angle 18\u00b0 to 21\u00b0", Symbol::patch, "band", 5},
            {"exact limit, friction angle 19.5\u00b0", Symbol::line, "theory", 5}};
}

/// One column of the difference plot.
struct Difference {
    std::string name;
    std::vector<const PaperRun*> runs;
};

std::vector<Difference> differences(const PaperResults& results) {
    std::vector<Difference> columns;
    for (const LaboratorySeries& series : kLaboratory) {
        Difference column{series.fissure == 0 ? "dry" : std::to_string(series.fissure), {}};
        for (const double friction : kPaperFrictionDeg) {
            if (const PaperRun* run = tableRun(results, series.fissure, friction)) column.runs.push_back(run);
        }
        columns.push_back(std::move(column));
    }
    for (const PaperRun* run : runsOf(results, PaperGroup::section5)) {
        const auto& fissures = run->what.fissures;
        std::string name = std::to_string(fissures.front());
        if (fissures.size() > 1) name += "-" + std::to_string(fissures.back());
        columns.push_back({"\u00a75: " + name, {run}});
    }
    return columns;
}

/// Half the height of the difference plot: the bracket with room, or as much as the data need [deg].
double differenceRange(const std::vector<Difference>& columns) {
    double range = 0.02;
    for (const Difference& column : columns) {
        for (const PaperRun* run : column.runs)
            range = std::max(range, 1.15 * std::abs(lessTheory(*run).value_or(0)));
    }
    return range;
}

/// Friction angles by symbol: 18 open square, 19.5 filled triangle, 21 open circle.
void drawDifference(Svg& svg, const PaperRun& run, double middle, const Axis& y) {
    const auto difference = lessTheory(run);
    if (!difference) return;
    const std::string tip = answerText(run) + ", less exact limit " + shownSigned(difference, 3);
    const double height = y.at(*difference);
    if (run.what.friction_deg < kTableFrictionDeg) {
        svg.square({middle - 13, height}, 5, "dem-open", tip);
    } else if (run.what.friction_deg > kTableFrictionDeg) {
        svg.circle({middle + 13, height}, 4.6, "dem-open", tip);
    } else {
        svg.triangle({middle, height}, 6, "dem", tip);
    }
}

void drawBracketBand(Svg& svg, const PaperResults& results, const Axis& x, const Axis& y) {
    if (results.runs.empty()) return;
    const double half = degrees(results.runs.front().what.scenario.model.analysis.tolerance) / 2;
    svg.polygon({{x.from, y.at(half)}, {x.to, y.at(half)}, {x.to, y.at(-half)}, {x.from, y.at(-half)}},
                "band");
}

void drawPointRule(Svg& svg, const PaperResults& results, const std::string& rule, Spot at) {
    const PaperRun* run = pointsRun(results, rule);
    if (!run || !criticalDeg(*run)) return;
    const std::string angle = text(*criticalDeg(*run), 2);
    svg.square(at, 7, "dem-ring", rule + ": " + angle + " " + failureText(*run));
    svg.label({at.x + 12, at.y + 16}, rule + " " + angle);
}

/// A rule that is no grid, in a place of its own on the axis.
void drawNamedRule(Svg& svg, const PaperResults& results, const std::string& rule, double place,
                   const Axis& x, const Axis& y) {
    const PaperRun* run = pointsRun(results, rule);
    svg.label({x.at(place), y.from + 18}, rule, "middle");
    if (!run || !criticalDeg(*run)) return;
    const bool slides = run->search.mode == FailureMode::sliding;
    svg.square({x.at(place), y.at(*criticalDeg(*run))}, 6, slides ? "dem" : "dem-open", answerText(*run));
    svg.label({x.at(place), y.at(*criticalDeg(*run)) + 24}, text(*criticalDeg(*run), 2), "middle", "small");
}

void drawGrids(Svg& svg, const PaperResults& results, const Axis& x, const Axis& y) {
    for (const PaperRun* run : runsOf(results, PaperGroup::points)) {
        const PointRule& rule = run->what.scenario.model.points;
        const auto angle = criticalDeg(*run);
        if (rule.kind != PointRule::Kind::grid || !angle) continue;
        svg.triangle({x.at(rule.grid), y.at(*angle)}, 5.5,
                     failureText(*run) == "sliding" ? "dem" : "dem-open",
                     run->what.points + ": " + text(*angle, 2) + " " + failureText(*run));
    }
}

std::vector<Spot> overturningCurve(const StackShape& stack, double friction, const Axis& x, const Axis& y) {
    std::vector<Spot> spots;
    const double height = stack.rows * stack.block.z();
    for (int n = 2; n <= kLastGrid; ++n) {
        const double tilt = std::min(gridOverturning(stack.block.x(), height, n), friction);
        spots.push_back({x.at(n), y.at(degrees(tilt))});
    }
    return spots;
}

}  // namespace

double gridOverturning(double b, double h, int n) { return std::atan((1.0 - 1.0 / n) * b / h); }

Svg plotFig6(const PaperResults& results) {
    Svg svg(720, 470, "Critical angle against L/H",
            "Critical angle in degrees against the distance of the watered fissure from the toe over the "
            "water depth: laboratory, DEM and exact limit.");
    const Axis x{0, 3.75, 64, 704, "L/H: distance of the fissure from the toe over water depth", 0.5, 1};
    const Axis y{0, 22, 420, 26, "critical angle (\u00b0)", 2, 0};
    const auto band = demBand(results, x, y);
    if (!band.empty()) svg.polygon(band, "band");
    drawAxes(svg, x, y);
    svg.label({x.from + 4, y.to - 7}, "fissure", "start", "small");
    drawPaperRatio(svg, x, y);
    drawDryLines(svg, results, x, y);
    const PaperRun* sample = tableRun(results, 1, kTableFrictionDeg);
    if (sample && sample->what.scenario.model.stack) svg.path(theoryCurve(*sample, x, y), "theory");
    drawWatered(svg, results, x, y);
    drawLegend(svg, {x.at(1.3), y.at(8.4)}, fig6Legend());
    return svg;
}

Svg plotDifference(const PaperResults& results) {
    const std::vector<Difference> columns = differences(results);
    Svg svg(720, 330, "DEM less exact limit",
            "Difference of the DEM's critical angle from the exact limit, in degrees.");
    const double range = differenceRange(columns);
    const Axis x{0, static_cast<double>(columns.size()), 90, 704, "watered fissure", 0, 0};
    const double step = niceStep(2 * range, 6);
    const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    const Axis y{-range, range, 248, 20, "DEM \u2212 exact limit (\u00b0)", step, decimals};
    drawBracketBand(svg, results, x, y);
    drawAxes(svg, x, y);
    svg.line({x.from, y.at(0)}, {x.to, y.at(0)}, "theory");
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const double middle = x.at(static_cast<double>(i) + 0.5);
        svg.label({middle, y.from + 18}, columns[i].name, "middle");
        for (const PaperRun* run : columns[i].runs) drawDifference(svg, *run, middle, y);
    }
    svg.label({72, 318}, "friction angle");
    drawLegend(svg, {168, 314}, {{"18\u00b0", Symbol::square, "dem-open", 5}});
    drawLegend(svg, {234, 314}, {{"19.5\u00b0", Symbol::triangle, "dem", 6}});
    drawLegend(svg, {312, 314}, {{"21\u00b0", Symbol::circle, "dem-open", 4.6}});
    drawLegend(svg, {400, 314}, {{"half the search\u2019s bracket either way", Symbol::patch, "band", 5}});
    return svg;
}

Svg plotPoints(const PaperResults& results) {
    Svg svg(720, 410, "Critical angle of the dry slope against the contact points",
            "The paper's four points per interface sit inside the edge and let the columns overturn too "
            "early; grids of N by N points approach the exact limit from below, points on the edge meet "
            "it.");
    const Axis x{
        1.4, 12.8, 64, 704, "N of a grid of N \u00d7 N contact points per interface, or the rule\u2019s name",
        0,   0};
    const Axis y{10, 21, 355, 16, "critical angle (\u00b0)", 1, 0};
    drawAxes(svg, x, y);
    for (int n = 2; n <= kLastGrid; ++n) svg.label({x.at(n), y.from + 18}, std::to_string(n), "middle");
    const PaperRun* sample = pointsRun(results, "vertex");
    if (sample && sample->what.scenario.model.stack) {
        const double friction = radians(sample->what.friction_deg);
        svg.line({x.from, y.at(sample->what.friction_deg)}, {x.to, y.at(sample->what.friction_deg)},
                 "theory");
        svg.path(overturningCurve(*sample->what.scenario.model.stack, friction, x, y), "rule");
    }
    drawGrids(svg, results, x, y);
    const PaperRun* quarter = pointsRun(results, "quarter");
    if (quarter)
        drawPointRule(svg, results, "quarter", {x.at(2), y.at(criticalDeg(*quarter).value_or(y.lo))});
    drawNamedRule(svg, results, "corner", 11.2, x, y);
    drawNamedRule(svg, results, "vertex", 12.2, x, y);
    drawLegend(svg, {x.at(5), y.at(14.2)},
               {{"exact limit: the slope slides", Symbol::line, "theory", 5},
                {"overturning about the outermost points", Symbol::line, "rule", 5},
                {"DEM, grid, fails by sliding", Symbol::triangle, "dem", 5.5},
                {"DEM, grid, fails otherwise", Symbol::triangle, "dem-open", 5.5},
                {"DEM, corner and vertex points", Symbol::square, "dem", 6}});
    return svg;
}

}  // namespace talus::tools
