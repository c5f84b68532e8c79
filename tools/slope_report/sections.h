#pragma once
// The sections of the page that describe the model: the analysis, water and bolts.

#include <string>
#include <vector>

#include "report/html.h"
#include "slope_report/slope_report.h"

namespace talus::tools {

void addQuestion(const SlopeReport& report, HtmlPage& page);
void addWaterAndBolts(const SlopeReport& report, HtmlPage& page);

/// The section of kinematics without its stereonets.
void addKinematicTests(const SlopeKinematics& kinematics, HtmlPage& page);

/// "3 blocks: b1, b2, b3"
std::string blocksText(const std::vector<std::string>& names, std::size_t limit = 12);
std::string figureText(double value);  ///< four significant digits
std::string capitalised(std::string text);

}  // namespace talus::tools
