#include "recording/motion_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "cli/json.h"
#include "cli/text.h"
#include "report/page.h"

namespace talus::tools {

namespace {

constexpr std::size_t kMostPoints = 2000;  // of a curve
constexpr std::size_t kMostCurves = 4;     // beside the largest: the page has no more colours
constexpr std::size_t kMostRows = 1000;    // of the table
constexpr std::array<const char*, kMostCurves> kRoles{"dem", "laboratory", "rule", "dots"};

/// Every so many rows, and the last.
template <class Rows, class Row>
Series curve(const std::string& role, const std::string& name, const Rows& rows, const Row& row) {
    Series series{"line", role, name, {}};
    const std::size_t stride = 1 + rows.size() / kMostPoints;
    for (std::size_t k = 0; k < rows.size(); ++k)
        if (k % stride == 0 || k + 1 == rows.size()) series.add(row(rows[k]));
    return series;
}

Plot plotOverTime(const std::string& id, const std::string& title, const std::string& what,
                  const std::string& axis) {
    return {id, title, what, PlotAxis{"time (s)"}, PlotAxis{axis}};
}

/// Blocks that move, the farthest first.
std::vector<std::size_t> byDistance(const formats::Scenario& scenario, const RunResult& result) {
    std::vector<std::size_t> order;
    for (std::size_t b = 0; b < result.displacements.size(); ++b)
        if (scenario.model.blocks[b].motion != Motion::fixed) order.push_back(b);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return result.displacements[a].norm() > result.displacements[b].norm();
    });
    return order;
}

Json displacementTable(const formats::Scenario& scenario, const RunResult& result,
                       const std::vector<std::size_t>& order) {
    Json rows = Json::array();
    for (const std::size_t b : order) {
        if (rows.size() == kMostRows) break;
        const Vec3& way = result.displacements[b];
        rows.push_back({scenario.model.blocks[b].name, way.norm(), way.x(), way.y(), way.z()});
    }
    const Json columns{textColumn("block"), numberColumn("displacement [m]", 5, "", kStart | kStrong),
                       numberColumn("x [m]", 5), numberColumn("y [m]", 5), numberColumn("z [m]", 5)};
    const std::string caption =
        order.size() > kMostRows
            ? "The " + std::to_string(kMostRows) + " that moved farthest, of " + std::to_string(order.size())
            : "All blocks that are not fixed, the farthest first";
    return table(caption, columns, std::move(rows));
}

}  // namespace

RunOutput MotionWatch::watching(RunOutput output) {
    output.record = [this, next = std::move(output.record)](const HistoryRecord& record) {
        Instant instant{record.time, {}, record.kinetic_energy, {}, record.ground_acceleration};
        for (const BlockReport& block : record.watch)
            instant.displacement.push_back(block.displacement.norm());
        support_names_.clear();
        for (const Supports& kind : record.supports)
            for (const SupportReport& support : kind.reports) {
                instant.supports.push_back(support.force);
                support_names_.push_back(support.name);
            }
        instants_.push_back(std::move(instant));
        if (next) next(record);
    };
    output.light = [this, next = std::move(output.light)](LightFrame&& frame) {
        Farthest farthest{frame.time, 0};
        const auto& [x, y, z] = frame.displacement;
        for (std::size_t b = 0; b < x.size(); ++b)
            farthest.displacement =
                std::max(farthest.displacement, std::hypot(double{x[b]}, double{y[b]}, double{z[b]}));
        farthest_.push_back(farthest);
        if (next) next(std::move(frame));
    };
    return output;
}

Json MotionWatch::displacements(const formats::Scenario& scenario) const {
    Plot plot =
        plotOverTime("displacement", "Displacement over time", "Against the ground.", "displacement (m)");
    plot.series.push_back(curve("theory", "largest of all blocks", farthest_, [](const Farthest& at) {
        return std::vector<double>{at.time, at.displacement};
    }));
    const std::vector<std::string>& watch = scenario.model.run.watch;
    for (std::size_t k = 0; k < std::min(watch.size(), kMostCurves); ++k)
        plot.series.push_back(curve(kRoles[k], watch[k], instants_, [k](const Instant& at) {
            return std::vector<double>{at.time, at.displacement[k]};
        }));
    return toJson(plot);
}

Json MotionWatch::supports() const {
    Plot plot = plotOverTime("supports", "Forces of the supports", "The first of them, where there are many.",
                             "force (kN)");
    constexpr std::array<const char*, kMostCurves + 1> kAll{"theory", "dem", "laboratory", "rule", "dots"};
    for (std::size_t k = 0; k < std::min(support_names_.size(), kAll.size()); ++k)
        plot.series.push_back(curve(kAll[k], support_names_[k], instants_, [k](const Instant& at) {
            return std::vector<double>{at.time, at.supports[k] / 1000};
        }));
    return toJson(plot);
}

Json MotionWatch::record() const {
    Plot plot = plotOverTime("record", "Acceleration of the ground", "The record as it was applied.",
                             "acceleration (m/s\u00b2)");
    constexpr std::array<std::pair<const char*, const char*>, 3> kAxes{
        {{"theory", "x"}, {"dem", "y"}, {"laboratory", "z"}}};
    for (int axis = 0; axis < 3; ++axis) {
        const bool shaken = std::any_of(instants_.begin(), instants_.end(), [axis](const Instant& at) {
            return at.ground && (*at.ground)[axis] != 0;
        });
        if (!shaken) continue;
        const auto& [role, name] = kAxes[static_cast<std::size_t>(axis)];
        plot.series.push_back(curve(role, name, instants_, [axis](const Instant& at) {
            return std::vector<double>{at.time, at.ground ? (*at.ground)[axis] : 0};
        }));
    }
    return plot.series.empty() ? Json(nullptr) : toJson(plot);
}

/// All plots over the same time, so that one can be read below the other.
void MotionWatch::overItsTime(Json& plot) const {
    if (instants_.size() > 1) plot["x"]["domain"] = {instants_.front().time, instants_.back().time};
}

Json MotionWatch::report(const formats::Scenario& scenario, const RunResult& result,
                         const Json& provenance) const {
    Report report;
    report.title = "Talus: motion of " + scenario.path;
    report.heading = "Motion of " + scenario.path;
    report.provenance = provenance;
    const std::vector<std::size_t> order = byDistance(scenario, result);
    if (!order.empty())
        report.opening.push_back(
            paragraph("Block " + scenario.model.blocks[order[0]].name +
                          " moved farthest: " + text(result.displacements[order[0]].norm(), 5) + " m in " +
                          text(result.simulated_seconds, 3) + " s" +
                          (scenario.model.ground_motion.empty() ? "." : ", against the moving ground."),
                      "lead"));
    if (result.interrupted)
        report.opening.push_back(paragraph("Interrupted: the page shows the run up to here.", "alert"));
    for (const std::string& warning : result.warnings) report.opening.push_back(paragraph(warning, "alert"));
    Json plots = Json::array({displacements(scenario)});
    if (Json shaking = record(); !shaking.is_null()) plots.push_back(std::move(shaking));
    for (Json& plot : plots) overItsTime(plot);
    report.sections.push_back(section("motion", "Motion", "Motion", std::move(plots)));
    report.sections.push_back(section("displacements", "Permanent displacement", "Permanent displacement",
                                      Json::array({displacementTable(scenario, result, order)})));
    if (!support_names_.empty()) {
        Json forces = supports();
        overItsTime(forces);
        report.sections.push_back(
            section("supports", "Supports", "Supports", Json::array({std::move(forces)})));
    }
    report.sections.push_back(
        section("origin", "Origin", "Provenance",
                {facts(provenanceFacts(provenance)), file(scenario.path, scenario.text)}));
    return toJson(report);
}

}  // namespace talus::tools
