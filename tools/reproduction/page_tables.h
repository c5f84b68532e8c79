#pragma once
// The tables of the page, each as HTML.

#include <string>

#include "reproduction/results.h"

namespace talus::tools {

std::string htmlTable1(const PaperResults& results);
std::string htmlSection5(const PaperResults& results);
std::string htmlDryPoints(const PaperResults& results);     ///< the study of contact points
std::string htmlQuarterWater(const PaperResults& results);  ///< the paper's points with water
std::string htmlCosts(const PaperResults& results);         ///< where the time went

}  // namespace talus::tools
