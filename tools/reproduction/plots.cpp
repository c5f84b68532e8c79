#include "reproduction/plots.h"

#include <algorithm>
#include <cmath>

#include "cli/text.h"
#include "report/svg.h"
#include "reproduction/laboratory.h"
#include "talus/theory.h"

namespace talus::tools {
namespace {

/// The straight cut of Fig. 6: the ratio beyond which the paper calls the water's push negligible.
constexpr double kPaperRatio = 3.0;

constexpr int kFirstGrid = 2, kLastGrid = 10;  ///< of the study of contact points

/// Single tests stand beside their average, which would hide them [px].
constexpr double kRepeatShift = 12;

const char* const kAngleTitle = "critical angle (\u00b0)";

double densityOf(const Model& model) { return model.blocks.empty() ? 0 : model.blocks.back().density; }

/// The exact limit with L as a continuous length, so that the curve passes between the fissures.
Series theoryCurve(const PaperRun& sample, const PlotAxis& x, const PlotAxis& y) {
    const Model& model = sample.what.scenario.model;
    theory::SlidingMass mass;
    mass.height = model.stack->rows * model.stack->block.z();
    mass.density = densityOf(model);
    mass.water_density = model.waters.front().density;
    mass.water_depth = sample.what.water_depth;
    mass.friction = radians(sample.what.friction_deg);
    Series curve{"line", "theory", "exact limit, friction angle 19.5\u00b0", {}};
    for (double ratio = x.domain[0]; ratio <= x.domain[1] + 1e-9; ratio += 0.01) {
        mass.length = ratio * mass.water_depth;
        const double angle = mass.length > 0 ? degrees(theory::criticalTiltSliding(mass)) : -1;
        if (angle >= y.domain[0] && angle <= y.domain[1]) curve.add({ratio, angle});
    }
    return curve;
}

/// Area between the DEM's answers at the smallest and the largest friction angle, over the watered fissures.
Series demBand(const PaperResults& results) {
    Series band{"band", "band", "DEM, friction angle 18\u00b0 to 21\u00b0", {}};
    for (const LaboratorySeries& series : kLaboratory) {
        const PaperRun* low = tableRun(results, series.fissure, kPaperFrictionDeg.front());
        const PaperRun* high = tableRun(results, series.fissure, kPaperFrictionDeg.back());
        if (!low || !high || !distanceOverDepth(low->what) || !criticalDeg(*low) || !criticalDeg(*high))
            continue;
        band.add({*distanceOverDepth(low->what), *criticalDeg(*low), *criticalDeg(*high)});
    }
    return band;
}

/// Laboratory and DEM at each watered fissure, and the fissure's number at the top.
void addWatered(Plot& plot, const PaperResults& results) {
    Series dem{"points", "dem", "DEM, friction angle 19.5\u00b0", {}, {}, "triangle", 6};
    Series average{"points", "laboratory", "laboratory, average of three", {}, {}, "circle", 6};
    Series repeats{"points", "repeat",     "laboratory, each test (set left)", {}, {}, "circle",
                   2,        -kRepeatShift};
    Series numbers{"labels", "muted", "", {}};
    for (const LaboratorySeries& series : kLaboratory) {
        const PaperRun* run = tableRun(results, series.fissure, kTableFrictionDeg);
        if (!run || !distanceOverDepth(run->what)) continue;
        const double ratio = *distanceOverDepth(run->what);
        const std::string name = std::to_string(series.fissure);
        numbers.add({ratio, plot.y.domain[1]}, (series.fissure == 1 ? "fissure " : "") + name);
        if (const auto angle = criticalDeg(*run)) dem.add({ratio, *angle}, answerText(*run));
        average.add({ratio, series.average_deg},
                    "fissure " + name + ", laboratory average " + text(series.average_deg, 1));
        for (const double repeat : series.repeats_deg)
            repeats.add({ratio, repeat}, "fissure " + name + ", laboratory test " + text(repeat, 1));
    }
    for (Series* series : {&average, &repeats, &dem, &numbers}) plot.series.push_back(std::move(*series));
}

void addDryLines(Plot& plot, const PaperResults& results) {
    const double laboratory = kLaboratory.front().average_deg;
    plot.references.push_back(
        {'y', laboratory, {}, "dots", "", "dry, laboratory " + text(laboratory, 1), true});
    const PaperRun* dry = tableRun(results, 0, kTableFrictionDeg);
    if (!dry || !criticalDeg(*dry)) return;
    plot.references.push_back(
        {'y', *criticalDeg(*dry), {}, "rule", "", "dry, DEM " + text(*criticalDeg(*dry), 2), false});
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

/// Rules of contact points in the order of the axis: the grids by fineness, then those with a name.
std::vector<std::string> pointRules() {
    std::vector<std::string> rules;
    for (int n = kFirstGrid; n <= kLastGrid; ++n) rules.push_back("grid " + std::to_string(n));
    rules.insert(rules.end(), {"quarter", "corner", "vertex"});
    return rules;
}

Series overturningCurve(const StackShape& stack, double friction) {
    Series curve{"line", "rule", "overturning about the outermost points", {}};
    const double height = stack.rows * stack.block.z();
    for (int n = kFirstGrid; n <= kLastGrid; ++n) {
        const double tilt = std::min(gridOverturning(stack.block.x(), height, n), friction);
        curve.add({static_cast<double>(n - kFirstGrid), degrees(tilt)});
    }
    return curve;
}

}  // namespace

double gridOverturning(double b, double h, int n) { return std::atan((1.0 - 1.0 / n) * b / h); }

Plot plotFig6(const PaperResults& results) {
    Plot plot{"plot-fig6", "Critical angle against L/H",
              "Critical angle in degrees against the distance of the watered fissure from the toe over the "
              "water depth: laboratory, DEM and exact limit.",
              PlotAxis{"L/H: distance of the fissure from the toe over water depth", {0, 3.75}, 0.5, 1},
              PlotAxis{kAngleTitle, {0, 22}, 2, 0}};
    plot.references.push_back({'x', kPaperRatio, {}, "dots", "", "beyond 3 the paper neglects the water"});
    addDryLines(plot, results);
    plot.series.push_back(demBand(results));
    const PaperRun* sample = tableRun(results, 1, kTableFrictionDeg);
    if (sample && sample->what.scenario.model.stack)
        plot.series.push_back(theoryCurve(*sample, plot.x, plot.y));
    addWatered(plot, results);
    return plot;
}

Plot plotDifference(const PaperResults& results) {
    const std::vector<Difference> columns = differences(results);
    const double range = differenceRange(columns);
    PlotAxis difference = axisOver("DEM \u2212 exact limit (\u00b0)", -range, range, 6);
    difference.domain = {-range, range};
    Plot plot{"plot-difference", "Difference from the exact limit",
              "The search ends with a bracket between the last tilt at which the slope stood and the first "
              "at which it failed; the answer is its middle.",
              PlotAxis{"watered fissure"}, std::move(difference)};
    // Side by side, apart by symbol as well.
    std::vector<Series> by_friction{
        {"points", "dem-open", "friction angle 18\u00b0", {}, {}, "square", 5, -10},
        {"points", "dem", "friction angle 19.5\u00b0", {}, {}, "triangle", 6, 0},
        {"points", "dem-open", "friction angle 21\u00b0", {}, {}, "circle", 4.6, 10}};
    for (const Difference& column : columns) {
        const auto place = static_cast<double>(plot.x.categories.size());
        plot.x.categories.push_back(column.name);
        for (const PaperRun* run : column.runs) {
            const auto difference = lessTheory(*run);
            const double friction = run->what.friction_deg;
            const std::size_t k = friction < kTableFrictionDeg ? 0 : friction > kTableFrictionDeg ? 2 : 1;
            if (difference)
                by_friction[k].add({place, *difference},
                                   answerText(*run) + ", less exact limit " + shownSigned(difference, 3));
        }
    }
    plot.series = std::move(by_friction);
    if (!results.runs.empty()) {
        const double half = degrees(results.runs.front().what.scenario.model.analysis.tolerance) / 2;
        plot.references.push_back(
            {'y', -half, half, "band", "half the search\u2019s bracket on either side"});
    }
    plot.references.push_back({'y', 0, {}, "theory"});
    return plot;
}

Plot plotPoints(const PaperResults& results) {
    Plot plot{
        "plot-points", "Critical angle of the dry slope against the contact points",
        "The paper\u2019s four points per interface sit inside the edge and let the columns overturn too "
        "early; grids of N by N points approach the exact limit from below, points on the edge meet "
        "it.",
        PlotAxis{"N of a grid of N \u00d7 N contact points per interface, or the rule\u2019s name"},
        PlotAxis{kAngleTitle, {10, 21}, 1, 0}};
    const std::vector<std::string> rules = pointRules();
    for (const std::string& rule : rules)
        plot.x.categories.push_back(rule.starts_with("grid ") ? rule.substr(5) : rule);
    const PaperRun* sample = pointsRun(results, "vertex");
    if (sample && sample->what.scenario.model.stack) {
        const double friction = sample->what.friction_deg;
        plot.references.push_back({'y', friction, {}, "theory", "exact limit: the slope slides"});
        plot.series.push_back(overturningCurve(*sample->what.scenario.model.stack, radians(friction)));
    }
    Series slides{"points", "dem", "DEM, grid, fails by sliding", {}, {}, "triangle", 5.5};
    Series topples{"points", "dem-open", "DEM, grid, fails otherwise", {}, {}, "triangle", 5.5};
    Series named{"points", "dem", "DEM, named rule, fails by sliding", {}, {}, "square", 6};
    Series named_topples{"points", "dem-open", "DEM, named rule, fails otherwise", {}, {}, "square", 6};
    Series values{"labels", "muted", "", {}};
    for (std::size_t i = 0; i < rules.size(); ++i) {
        const PaperRun* run = pointsRun(results, rules[i]);
        const auto angle = run ? criticalDeg(*run) : std::nullopt;
        if (!angle) continue;
        const bool is_grid = rules[i].starts_with("grid "), is_sliding = failureText(*run) == "sliding";
        Series& series = is_grid ? (is_sliding ? slides : topples) : is_sliding ? named : named_topples;
        const auto place = static_cast<double>(i);
        series.add({place, *angle}, rules[i] + ": " + text(*angle, 2) + " " + failureText(*run));
        if (!is_grid) values.add({place, *angle}, text(*angle, 2));
    }
    for (Series* series : {&slides, &topples, &named, &named_topples, &values})
        if (!series->rows.empty()) plot.series.push_back(std::move(*series));
    return plot;
}

}  // namespace talus::tools
