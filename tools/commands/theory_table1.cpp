// The paper's Table 1 beside the exact limits of sliding.

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/failures.h"
#include "cli/json.h"
#include "cli/text.h"
#include "commands/theory_formulas.h"
#include "reproduction/laboratory.h"
#include "talus/theory.h"

namespace talus::tools {

namespace {

/// The paper's slope: columns of 0.2 m x 0.5 m; without water every mass slides at phi.
double tableAngle(const LaboratorySeries& series, double friction_deg) {
    const bool dry = series.fissure == 0;
    return degrees(
        theory::criticalTiltSliding({0.2 * (dry ? 7 : series.fissure), 0.5, 2700, 1000,
                                     dry ? 0 : kLaboratoryWaterDepth, radians(friction_deg), 0, 9.81}));
}

std::string cell(const std::string& content) {
    constexpr std::size_t kWidth = 12;
    return std::string(kWidth - std::min(kWidth, content.size()), ' ') + content;
}

Json tableRow(const LaboratorySeries& series, const std::vector<double>& friction_deg) {
    Json angles = Json::array();
    for (const double phi : friction_deg) angles.push_back(number(tableAngle(series, phi)));
    return {{"fissure", series.fissure == 0 ? Json(nullptr) : Json(series.fissure)},
            {"water_depth_m", series.fissure == 0 ? 0.0 : kLaboratoryWaterDepth},
            {"laboratory_deg", series.average_deg},
            {"theory_deg", angles}};
}

std::string tableLine(const LaboratorySeries& series, const std::vector<double>& friction_deg) {
    std::string line = series.fissure == 0 ? "dry      " : "fissure " + std::to_string(series.fissure);
    line += cell(text(series.average_deg, 1));
    for (const double phi : friction_deg) line += cell(text(tableAngle(series, phi), 2));
    return line + "\n";
}

int table1(const Common& common, const std::vector<double>& friction_deg) {
    if (common.json) {
        Json json{{"friction_deg", friction_deg}, {"rows", Json::array()}};
        for (const LaboratorySeries& series : kLaboratory)
            json["rows"].push_back(tableRow(series, friction_deg));
        printJson(json);
        return kDone;
    }
    std::string lines =
        "Critical angles [deg]: the paper's Table 1, and the exact limits of sliding\n           laboratory";
    for (const double phi : friction_deg) lines += cell("phi " + text(phi, 1));
    lines += "\n";
    for (const LaboratorySeries& series : kLaboratory) lines += tableLine(series, friction_deg);
    printText(lines);
    return kDone;
}

}  // namespace

Command addTable1(CLI::App& parent, std::shared_ptr<Common> common) {
    auto friction_deg =
        std::make_shared<std::vector<double>>(kPaperFrictionDeg.begin(), kPaperFrictionDeg.end());
    CLI::App* app = addFormula(parent, *common, "table1", "The paper's Table 1 and the exact limits",
                               "--friction 18 19.5 21");
    app->add_option("--friction", *friction_deg, "Friction angles [deg]")
        ->check(within(0, 89))
        ->capture_default_str();
    return {app, [common, friction_deg] { return table1(*common, *friction_deg); }};
}

}  // namespace talus::tools
