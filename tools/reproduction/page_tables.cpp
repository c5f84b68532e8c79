#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/json.h"
#include "cli/text.h"
#include "report/page.h"
#include "reproduction/laboratory.h"
#include "reproduction/notes.h"
#include "reproduction/page.h"

namespace talus::tools {
namespace {

std::string testsText(const LaboratorySeries& series) {
    std::string list;
    for (const double repeat : series.repeats_deg) list += (list.empty() ? "" : " ") + text(repeat, 1);
    return list;
}

/// How it fails, or why there is no answer.
std::string outcome(const PaperRun& run) { return criticalDeg(run) ? failureText(run) : statusText(run); }

/// A friction angle as the head of a column.
std::string frictionTitle(double friction_deg) {
    return text(friction_deg, friction_deg == std::floor(friction_deg) ? 0 : 1);
}

Json table1Columns() {
    Json columns{textColumn("water in"), numberColumn("L/H", 2),
                 numberColumn("average", 1, "laboratory", kStart), numberColumn("tests", 1, "laboratory")};
    for (const auto& [group, is_dem] : {std::pair{"DEM, \u03c6 =", true}, {"exact limit, \u03c6 =", false}})
        for (const double friction : kPaperFrictionDeg) {
            const bool first = friction == kPaperFrictionDeg.front();
            const bool middle = is_dem && friction == kTableFrictionDeg;
            columns.push_back(numberColumn(frictionTitle(friction), 2, group,
                                           first    ? kStart
                                           : middle ? kStrong
                                                    : kPlain));
        }
    columns.push_back(numberColumn("largest", 3, "DEM \u2212 exact", kStart | kSigned));
    columns.push_back(numberColumn("\u03c6 = 19.5", 2, "DEM \u2212 lab.", kStart | kSigned));
    columns.push_back(numberColumn("laboratory", 1, "\u03c6 from", kStart));
    columns.push_back(textColumn("fails by", "", kStart));
    return columns;
}

/// Nothing when the fissure's cases are not there.
Json table1Row(const PaperResults& results, const LaboratorySeries& series) {
    const PaperRun* middle = tableRun(results, series.fissure, kTableFrictionDeg);
    if (!middle) return nullptr;
    Json row{label(middle->what), maybe(distanceOverDepth(middle->what)), series.average_deg,
             testsText(series)};
    Json exact = Json::array();
    std::vector<std::optional<double>> differences;
    for (const double friction : kPaperFrictionDeg) {
        const PaperRun* run = tableRun(results, series.fissure, friction);
        row.push_back(maybe(run ? criticalDeg(*run) : std::nullopt));
        exact.push_back(maybe(run ? theoryDeg(*run) : std::nullopt));
        if (run) differences.push_back(lessTheory(*run));
    }
    for (const Json& value : exact) row.push_back(value);
    row.push_back(maybe(largest(differences)));
    row.push_back(maybe(lessPaper(*middle)));
    row.push_back(maybe(impliedFrictionDeg(middle->what, series.average_deg)));
    row.push_back(outcome(*middle));
    return row;
}

/// "3.375e11"
std::string scientific(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.4g", value);
    std::string number = buffer;
    if (const auto exponent = number.find("e+"); exponent != std::string::npos) number.erase(exponent + 1, 1);
    return number;
}

std::string stackText(const StackShape& stack) {
    return std::to_string(stack.columns) + " columns, " + std::to_string(stack.rows) + " rows, " +
           std::to_string(stack.slices) + " slices of blocks " + text(stack.block.x(), 1) + " m \u00d7 " +
           text(stack.block.y(), 1) + " m \u00d7 " + text(stack.block.z(), 1) +
           " m on a fixed floor; twelve columns in section 5, one slice in the study of contact points";
}

std::string jointText(const Joint& joint) {
    return "normal stiffness " + scientific(joint.normal_stiffness) + " Pa/m, shear stiffness " +
           scientific(joint.shear_stiffness) + " Pa/m, cohesion " + text(joint.cohesion, 0) +
           " Pa, friction angle as stated";
}

/// Of the first case with water; "" when there is none.
std::string waterText(const PaperResults& results) {
    for (const PaperRun& run : results.runs) {
        if (run.what.fissures.empty() || run.what.scenario.model.waters.empty()) continue;
        return text(run.what.water_depth, 2) + " m up along the joint, " +
               text(run.what.scenario.model.waters.front().density, 0) +
               " kg/m\u00b3, level surface; pushes on both walls, also when the joint opens";
    }
    return "";
}

}  // namespace

Json table1(const PaperResults& results) {
    Json rows = Json::array();
    for (const LaboratorySeries& series : kLaboratory)
        if (Json row = table1Row(results, series); !row.is_null()) rows.push_back(std::move(row));
    return table("Critical angle in degrees; friction angle \u03c6 in degrees", table1Columns(), rows);
}

Json section5Table(const PaperResults& results) {
    Json rows = Json::array();
    for (const PaperRun* run : runsOf(results, PaperGroup::section5))
        rows.push_back({label(run->what), maybe(distanceOverDepth(run->what)), maybe(run->what.paper_deg),
                        maybe(criticalDeg(*run)), maybe(theoryDeg(*run)), maybe(lessTheory(*run)),
                        maybe(lessPaper(*run)), outcome(*run), movingText(*run)});
    return table(
        "Twelve columns, friction angle 19.5\u00b0; critical angle in degrees",
        {textColumn("water in"), numberColumn("L/H", 2), numberColumn("paper\u2019s DEM", 1, "", kStart),
         numberColumn("DEM", 2, "", kStrong), numberColumn("exact limit", 2),
         numberColumn("DEM \u2212 exact", 3, "", kSigned), numberColumn("DEM \u2212 paper", 2, "", kSigned),
         textColumn("fails by", "", kStart), textColumn("moving")},
        rows);
}

Json dryPointsTable(const PaperResults& results) {
    Json rows = Json::array();
    for (const PaperRun* run : runsOf(results, PaperGroup::points))
        rows.push_back({run->what.points, maybe(criticalDeg(*run)), maybe(theoryDeg(*run)),
                        maybe(lessTheory(*run)), outcome(*run), movingText(*run)});
    return table("Dry slope: critical angle in degrees",
                 {textColumn("points"), numberColumn("DEM", 2, "", kStrong), numberColumn("exact limit", 2),
                  numberColumn("DEM \u2212 exact", 2, "", kSigned), textColumn("fails by", "", kStart),
                  textColumn("moving")},
                 rows);
}

Json quarterWaterTable(const PaperResults& results) {
    Json rows = Json::array();
    for (const PaperRun* run : runsOf(results, PaperGroup::quarter_water)) {
        const int fissure = run->what.fissures.front();
        const PaperRun* whole = tableRun(results, fissure, kTableFrictionDeg);
        rows.push_back({label(run->what), kLaboratory[static_cast<std::size_t>(fissure)].average_deg,
                        maybe(criticalDeg(*run)), outcome(*run),
                        maybe(whole ? criticalDeg(*whole) : std::nullopt), maybe(theoryDeg(*run))});
    }
    return table("Quarter points with water: critical angle in degrees",
                 {textColumn("water in"), numberColumn("laboratory", 1),
                  numberColumn("quarter", 2, "", kStart | kStrong), textColumn("fails by"),
                  numberColumn(results.table_points, 2, "", kStart), numberColumn("exact limit", 2)},
                 rows);
}

Json costsTable(const PaperResults& results) {
    Json rows = Json::array();
    for (const GroupCost& cost : groupCosts(results)) {
        const auto steps = static_cast<double>(cost.steps);
        rows.push_back({groupTitle(cost.group), cost.cases, cost.cpu_seconds, steps * 1e-6,
                        steps > 0 ? Json(1e6 * cost.cpu_seconds / steps) : Json(nullptr)});
    }
    return table("Where the time went",
                 {textColumn("group"), numberColumn("cases", 0), numberColumn("CPU s", 1),
                  numberColumn("million steps", 2), numberColumn("\u00b5s per step", 1)},
                 rows);
}

std::vector<std::pair<std::string, std::string>> parameters(const PaperResults& results) {
    if (results.runs.empty()) return {};
    const Model& model = results.runs.front().what.scenario.model;
    std::vector<std::pair<std::string, std::string>> list;
    if (model.stack) list.emplace_back("Slope", stackText(*model.stack));
    if (!model.blocks.empty())
        list.emplace_back("Density", text(model.blocks.back().density, 0) + " kg/m\u00b3");
    if (!model.joints.empty()) list.emplace_back("Joints", jointText(model.joints.front()));
    list.emplace_back("Gravity", text(model.gravity.magnitude, 2) + " m/s\u00b2");
    if (const std::string water = waterText(results); !water.empty()) list.emplace_back("Water", water);
    list.emplace_back("Contact points", results.table_points + " (Table 1 and section 5)");
    list.emplace_back("Search",
                      "the equilibrium path is followed as the slope is tilted, to the peak beyond which "
                      "blocks part; bracket " +
                          text(degrees(model.analysis.tolerance), 3) + "\u00b0");
    return list;
}

}  // namespace talus::tools
