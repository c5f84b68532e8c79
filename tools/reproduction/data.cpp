#include "reproduction/data.h"

#include "cli/json.h"
#include "cli/text.h"
#include "report/csv.h"
#include "report/page.h"
#include "reproduction/laboratory.h"

namespace talus::tools {
namespace {

Json fissureJson(const std::vector<int>& fissures) {
    if (fissures.empty()) return nullptr;
    return fissures.size() == 1 ? Json(fissures.front()) : Json(fissures);
}

/// [low, high] in degrees, null at an open end; null when the case has no search result.
Json bracketJson(const PaperRun& run) {
    if (!run.begun || !run.errors.empty()) return nullptr;
    return Json::array({number(degrees(run.search.low)), number(degrees(run.search.high))});
}

Json caseJson(const PaperRun& run) {
    const bool computed = run.begun && run.errors.empty();
    Json json{{"name", run.what.name},
              {"group", groupName(run.what.group)},
              {"fissure", fissureJson(run.what.fissures)},
              {"water_depth_m", run.what.water_depth},
              {"points", run.what.points},
              {"friction_deg", run.what.friction_deg},
              {"status", statusText(run)},
              {"critical_angle_deg", maybe(criticalDeg(run))},
              {"bracket_deg", bracketJson(run)},
              {"theory_deg", maybe(theoryDeg(run))},
              {"paper_deg", maybe(run.what.paper_deg)},
              {"failure_mode", talus::toString(run.search.mode)},
              {"moving_blocks", run.search.moving_blocks},
              {"probes", run.search.probes.size()},
              {"steps", run.search.steps},
              {"cpu_seconds", run.cpu_seconds},
              {"state_hash", computed ? Json(hashText(run.search.state_hash)) : Json(nullptr)}};
    if (!run.search.warnings.empty()) json["warnings"] = run.search.warnings;
    if (!run.errors.empty()) json["errors"] = errorsJson(run.errors)["errors"];
    return json;
}

std::string cell(std::optional<double> value, int decimals) {
    return value ? text(*value, decimals) : std::string();
}

/// "1", or "7 8 9 10".
std::string fissureCell(const std::vector<int>& fissures) {
    std::string list;
    for (const int fissure : fissures) list += (list.empty() ? "" : " ") + std::to_string(fissure);
    return list;
}

std::vector<std::string> csvHead() {
    return {"group",
            "name",
            "fissure",
            "L_m",
            "water_depth_m",
            "L_over_H",
            "points",
            "friction_deg",
            "status",
            "critical_angle_deg",
            "bracket_low_deg",
            "bracket_high_deg",
            "theory_deg",
            "paper_deg",
            "dem_less_theory_deg",
            "dem_less_paper_deg",
            "failure_mode",
            "moving_blocks",
            "probes",
            "steps",
            "cpu_s",
            "state_hash"};
}

std::vector<std::string> csvRow(const PaperRun& run) {
    const bool found = criticalDeg(run).has_value();
    const auto bound = [&](double value) { return found ? text(degrees(value), 4) : std::string(); };
    return {groupName(run.what.group),
            run.what.name,
            fissureCell(run.what.fissures),
            cell(fissureDistance(run.what), 3),
            text(run.what.water_depth, 3),
            cell(distanceOverDepth(run.what), 4),
            run.what.points,
            text(run.what.friction_deg, 1),
            statusText(run),
            cell(criticalDeg(run), 4),
            bound(run.search.low),
            bound(run.search.high),
            cell(theoryDeg(run), 4),
            cell(run.what.paper_deg, 1),
            cell(lessTheory(run), 4),
            cell(lessPaper(run), 4),
            failureText(run),
            std::to_string(run.search.moving_blocks.size()),
            std::to_string(run.search.probes.size()),
            std::to_string(run.search.steps),
            text(run.cpu_seconds, 3),
            run.begun && run.errors.empty() ? hashText(run.search.state_hash) : std::string()};
}

}  // namespace

Json paperJson(const PaperResults& results) {
    Json kept_runs = Json::array();
    for (const PaperKept& kept : results.kept) {
        Json one = keptRunJson(kept.run);
        one["name"] = results.runs[kept.of].what.name;
        one["file"] = kept.run.file.empty() ? Json(nullptr) : Json(kept.file);
        one["page"] = kept.run.file.empty() ? Json(nullptr) : Json(kept.page);
        kept_runs.push_back(std::move(one));
    }
    Json cases = Json::array();
    std::int64_t steps = 0;
    double cpu = 0;
    for (const PaperRun& run : results.runs) {
        cases.push_back(caseJson(run));
        steps += run.search.steps;
        cpu += run.cpu_seconds;
    }
    return Json{{"cases", cases},
                {"monte_carlo", results.scatter ? scatterJson(*results.scatter) : Json(nullptr)},
                {"kept_runs", kept_runs},
                {"water_bag", bagJson(results.bag)},
                {"interrupted", results.interrupted},
                {"steps", steps},
                {"cpu_seconds", cpu},
                {"wall_seconds", results.wall_seconds},
                {"threads", results.threads},
                {"provenance", results.provenance}};
}

std::string paperCsv(const PaperResults& results) {
    std::string csv = results.provenance_comments + csvLine(csvHead());
    for (const PaperRun& run : results.runs) csv += csvLine(csvRow(run));
    return csv;
}

std::string laboratoryCsv(const PaperResults& results) {
    std::string csv = results.provenance_comments +
                      "# source: the paper's Table 1\n"
                      "fissure,water_depth_m,test_1_deg,test_2_deg,test_3_deg,average_deg\n";
    for (const LaboratorySeries& series : kLaboratory) {
        std::vector<std::string> fields{series.fissure == 0 ? "" : std::to_string(series.fissure),
                                        text(series.fissure == 0 ? 0 : kLaboratoryWaterDepth, 2)};
        for (const double repeat : series.repeats_deg) fields.push_back(text(repeat, 1));
        fields.push_back(text(series.average_deg, 1));
        csv += csvLine(fields);
    }
    return csv;
}

}  // namespace talus::tools
