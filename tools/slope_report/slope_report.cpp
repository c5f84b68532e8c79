#include "slope_report/slope_report.h"

#include <filesystem>

#include "answers/keyblocks_report.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/outputs.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "slope_report/stages.h"
#include "talus/formats/fractures.h"

namespace talus::tools {

namespace {

namespace fs = std::filesystem;

bool isStopped(const Control& control) { return control.stop != nullptr && control.stop->load(); }

/// As talus kinematics; its faults are the reason for a missing stereonet.
void addKinematics(const formats::Scenario& scenario, const SlopeReportRequest& request,
                   SlopeReport& report) {
    const auto face = netFace(scenario, request.slope);
    const auto joints = formats::rockJoints(scenario);
    if (!joints || joints->empty()) {
        report.no_kinematics = "The scenario has no joint sets, so there is no stereonet.";
        return;
    }
    if (!face) {
        report.no_kinematics =
            "The model has no outer faces that a face could be taken from; --slope "
            "gives one.";
        return;
    }
    if (joints->size() > kinematics::kMostPoles) {
        report.no_kinematics =
            "The rock mass has " + std::to_string(joints->size()) + " planes, more than a stereonet tests.";
        return;
    }
    KinematicsQuestion question;
    question.face = face->value;
    const Chosen<double> friction = netFriction(scenario.model);
    question.limits = {friction.value, radians(kLateralDeg)};
    report.kinematics =
        SlopeKinematics{answerKinematics(polesOf(scenario, question), question), *face, friction};
}

Json trialJson(const LoadSearch& search, const SensitivityTrial& trial) {
    const bool is_found = trial.status == SearchStatus::found;
    return {{"change", trial.what},
            {"status", toString(trial.status)},
            {search.answer_key, is_found ? number(trial.answer / search.load->scale) : Json(nullptr)},
            {"failure_mode", toString(trial.mode)},
            {"failing_volume_m3", number(trial.volume)},
            {"failing_mass_kg", number(trial.mass)}};
}

}  // namespace

std::optional<SlopeReport> computeSlopeReport(const formats::Scenario& scenario,
                                              const SlopeReportRequest& request, const Common& common,
                                              const Control& control) {
    constexpr double kOneSearch = 0.75;  // of the whole, without sensitivity: the rest is block theory
    constexpr double kOneOfSeven = 0.2;  // with it
    const Chosen<const LoadSearch*> analysis = analysisOf(scenario, request.analysis);
    netFace(scenario, request.slope);  // its faults before a search of minutes
    const double searched = request.sensitivity ? kOneOfSeven : kOneSearch;
    const double judged = request.sensitivity ? searched + 0.05 : 1;
    SearchRequest wish;
    wish.groups = request.groups;
    SlopeReport report{
        analysis,
        answer(*analysis.value, scenario, wish, common, stageOf(control, "search", 0, searched)),
        {}};
    if (isStopped(control)) return std::nullopt;
    report.key_blocks =
        valueOf(keyBlocks(scenario.model, stageOf(control, "key blocks", searched, judged)), scenario);
    if (isStopped(control)) return std::nullopt;
    addKinematics(scenario, request, report);
    report.share = request.sensitivity;
    if (request.sensitivity) {
        auto trials =
            sensitivities(scenario, *analysis.value, *request.sensitivity, stageOf(control, "", judged, 1));
        if (!trials) return std::nullopt;
        report.sensitivity = std::move(*trials);
    }
    return report;
}

SlopeReportFiles slopeReportFiles(const std::string& page, const std::string& folder) {
    if (!folder.empty()) return {page, folder};
    const fs::path path(page);
    return {page, (path.parent_path() / (path.stem().string() + "_figures")).string()};
}

void refuseSlopeReportFiles(const SlopeReportFiles& files) {
    requireEnding("--output", files.page, {".html"});
    refuseInput("--output", files.page);
    refuseUnwritable(files.page);
    makeFolder(files.folder);
}

void writeSlopeReport(const SlopeReport& report, SlopeReportFiles& files) {
    const std::vector<ReportFigure> figures = figuresOf(report);
    for (const ReportFigure& figure : figures) {
        for (const auto& [ending, content] :
             {std::pair{".svg", &figure.svg}, std::pair{".csv", &figure.csv}}) {
            const std::string file = (fs::path(files.folder) / (figure.name + ending)).string();
            refuseInput("--figures", file);
            writeFile(file, *content);
            files.figures.push_back(file);
        }
    }
    writeFile(files.page, slopePage(report, figures));
}

Json slopeReportJson(const SlopeReport& report, const SlopeReportFiles& files) {
    const SearchReport& search = report.search;
    Json trials = Json::array();
    for (const Sensitivity& one : report.sensitivity) {
        trials.push_back({{"quantity", one.quantity},
                          {"change", one.change},
                          {"less", trialJson(search.search, one.less)},
                          {"more", trialJson(search.search, one.more)}});
    }
    return {{"page", files.page},
            {"figures", files.figures},
            {"analysis", search.search.name},
            {"search", searchJson(search)},
            {"key_blocks", keyBlocksJson(report.key_blocks, search.common, search.scenario)},
            {"sensitivity", std::move(trials)}};
}

}  // namespace talus::tools
