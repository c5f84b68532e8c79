#pragma once
// Data of the page of `talus report`.

#include <optional>
#include <string>
#include <vector>

#include "answers/kinematics.h"
#include "answers/search.h"
#include "cli/json_fwd.h"
#include "slope_report/question.h"
#include "slope_report/sensitivity.h"
#include "talus/block_theory.h"

namespace talus::tools {

struct SlopeReportRequest {
    std::string analysis{};             ///< a search's name; empty: by the scenario
    std::string slope{};                ///< of the stereonet, "65/270"; empty: by the model
    int groups = 1;                     ///< most groups of the search to follow
    std::optional<double> sensitivity;  ///< share of the change; nothing: no sensitivity
};

/// The planes of a scenario with joint sets on the stereonet.
struct SlopeKinematics {
    KinematicsAnswer answer;
    Chosen<kinematics::Face> face;
    Chosen<double> friction;
};

struct SlopeReport {
    Chosen<const LoadSearch*> analysis;
    SearchReport search;
    KeyBlockResult key_blocks;
    std::optional<SlopeKinematics> kinematics{};
    std::string no_kinematics{};  ///< why there are none
    std::optional<double> share{};
    std::vector<Sensitivity> sensitivity{};
};

/// Nothing after an interruption. Objects that the report refers to must outlive it. Throws BadInput.
std::optional<SlopeReport> computeSlopeReport(const formats::Scenario& scenario,
                                              const SlopeReportRequest& request, const Common& common,
                                              const Control& control);

/// A figure of the report, which is a file beside it, too.
struct ReportFigure {
    std::string name;     ///< of its files and of its element
    std::string caption;  ///< for the page
    std::string svg, csv;
};

std::vector<ReportFigure> figuresOf(const SlopeReport& report);

/// The page. \param figures  all of the report
std::string slopePage(const SlopeReport& report, const std::vector<ReportFigure>& figures);

/// Paths of a report.
struct SlopeReportFiles {
    std::string page, folder;
    std::vector<std::string> figures{};  ///< files, in order
};

/// \param folder  empty: beside the page, "slope_figures" of "slope.html"
SlopeReportFiles slopeReportFiles(const std::string& page, const std::string& folder);
/// Before a search of minutes. Throws BadInput, FileRefused.
void refuseSlopeReportFiles(const SlopeReportFiles& files);
/// Writes page and figures, and adds the figures to `files`. Throws FileRefused.
void writeSlopeReport(const SlopeReport& report, SlopeReportFiles& files);

/// {page, figures, analysis, search, key_blocks, sensitivity}
Json slopeReportJson(const SlopeReport& report, const SlopeReportFiles& files);

}  // namespace talus::tools
