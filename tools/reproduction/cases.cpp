#include "reproduction/cases.h"

#include <algorithm>
#include <string_view>

#include "cli/failures.h"
#include "cli/text.h"
#include "paper_scenarios.h"
#include "reproduction/laboratory.h"
#include "reproduction/scenario_text.h"

namespace talus::tools {
namespace {

constexpr int kFinestGrid = 10;

std::string scenarioText(std::string_view name) {
    for (const auto& scenario : kPaperScenarios) {
        if (scenario.name == name) return std::string(scenario.text);
    }
    throw std::logic_error("no built-in scenario named " + std::string(name));
}

/// Changes of a case against its base scenario.
struct Variant {
    PaperGroup group;
    std::string scenario;  ///< built-in
    std::string name;
    std::vector<int> fissures;
    double friction_deg = kTableFrictionDeg;
    std::string points;
    std::optional<double> paper_deg{};
};

bool oneSlice(PaperGroup group) { return group == PaperGroup::points || group == PaperGroup::quarter_water; }

std::string variantText(const Variant& variant) {
    std::string scenario = scenarioText(variant.scenario);
    scenario = withValue(scenario, "[joint.default]", "friction_deg", text(variant.friction_deg, 1));
    scenario = withValue(scenario, "[contact]", "points", '"' + variant.points + '"');
    return oneSlice(variant.group) ? withValue(scenario, "[[stack]]", "slices", "1") : scenario;
}

PaperCase makeCase(const Variant& variant) {
    PaperCase made{variant.group,
                   variant.name,
                   variant.fissures,
                   0,
                   variant.friction_deg,
                   variant.points,
                   variant.paper_deg,
                   {},
                   {}};
    made.scenario = valueOf(formats::parseScenario(variantText(variant), variant.name + ".toml"));
    const Model& model = made.scenario.model;
    if (!model.waters.empty()) made.water_depth = model.waters.front().level.front().value;
    made.theory = theory::predict(model);
    return made;
}

std::string fissureName(int fissure) { return fissure == 0 ? "dry" : "fissure-" + std::to_string(fissure); }

std::vector<int> fissureList(int fissure) {
    return fissure == 0 ? std::vector<int>{} : std::vector<int>{fissure};
}

void addTable(std::vector<PaperCase>& cases, const std::string& points) {
    for (const LaboratorySeries& series : kLaboratory) {
        const std::string name = fissureName(series.fissure);
        for (const double friction : kPaperFrictionDeg) {
            cases.push_back(makeCase({PaperGroup::table, name, name, fissureList(series.fissure), friction,
                                      points, series.average_deg}));
        }
    }
}

void addSection5(std::vector<PaperCase>& cases, const std::string& points) {
    cases.push_back(makeCase({PaperGroup::section5,
                              "section5-fissure-7",
                              "section5-fissure-7",
                              {7},
                              kTableFrictionDeg,
                              points,
                              kPaperDemFissure7Deg}));
    cases.push_back(makeCase({PaperGroup::section5,
                              "section5-fissures-7-10",
                              "section5-fissures-7-10",
                              {7, 8, 9, 10},
                              kTableFrictionDeg,
                              points,
                              kPaperDemFissures7To10Deg}));
}

void addPointsStudy(std::vector<PaperCase>& cases) {
    std::vector<std::string> rules{"quarter", "corner", "vertex"};
    for (int grid = 2; grid <= kFinestGrid; ++grid) rules.push_back("grid " + std::to_string(grid));
    for (const std::string& rule : rules) {
        std::string name = "points-" + rule;
        std::replace(name.begin(), name.end(), ' ', '-');
        cases.push_back(makeCase({PaperGroup::points, "lp-study", name, {}, kTableFrictionDeg, rule}));
    }
}

void addQuarterWithWater(std::vector<PaperCase>& cases) {
    for (const LaboratorySeries& series : kLaboratory) {
        if (series.fissure == 0) continue;
        const std::string name = fissureName(series.fissure);
        cases.push_back(makeCase({PaperGroup::quarter_water,
                                  name,
                                  "quarter-" + name,
                                  {series.fissure},
                                  kTableFrictionDeg,
                                  "quarter"}));
    }
}

/// A rule from the command line becomes text inside a TOML string, so anything else is refused before.
void checkPoints(const std::string& points) {
    constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789 ";
    if (points.find_first_not_of(kLetters) == std::string::npos) {
        const std::string scenario =
            withValue(scenarioText("dry"), "[contact]", "points", '"' + points + '"');
        const auto parsed = formats::parseScenario(scenario, "");
        if (parsed.ok()) return;
    }
    throw BadInput(Error{
        "--points", "found \"" + points + "\", allowed: \"quarter\", \"corner\", \"vertex\" or \"grid N\""});
}

double pointsPerInterface(const PointRule& rule) {
    switch (rule.kind) {
        case PointRule::Kind::vertex:
        case PointRule::Kind::distributed:
            return 9;
        case PointRule::Kind::quarter:
        case PointRule::Kind::corner:
            return 4;
        case PointRule::Kind::grid:
            return rule.grid * rule.grid;
    }
    return 1;
}

}  // namespace

std::vector<PaperCase> paperCases(const std::string& points) {
    checkPoints(points);
    std::vector<PaperCase> cases;
    addTable(cases, points);
    addSection5(cases, points);
    addPointsStudy(cases);
    addQuarterWithWater(cases);
    return cases;
}

double expectedCost(const PaperCase& what) {
    const Model& model = what.scenario.model;
    return static_cast<double>(model.blocks.size()) * (10 + pointsPerInterface(model.points));
}

}  // namespace talus::tools
