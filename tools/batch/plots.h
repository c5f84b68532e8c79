#pragma once
// The plots of a batch's page.

#include <optional>
#include <string>
#include <vector>

#include "batch/summary.h"
#include "report/svg.h"

namespace talus::tools::batch {

/// How often each answer came up.
Svg plotHistogram(const Summary& summary);

/// Share of the runs that have failed, against the answer, with the confidence band of each point.
Svg plotDistribution(const Summary& summary);

/// Rank correlation of the answer with what varies, the strongest on top.
Svg plotTornado(const Summary& summary);

/// The answer against one column that varies: every run, and the mean at each value when there are few values.
Svg plotResponse(const Summary& summary, std::size_t value);

/// Mean answer over two columns with few values each.
Svg plotHeatMap(const Summary& summary, std::size_t x_value, std::size_t y_value);

/// Distinct values of a column among the runs with a finite answer, sorted.
std::vector<double> valuesOf(const Summary& summary, std::size_t value);

/// CSS of the heat map's colours.
std::string heatStyle(const std::string& scope);

}  // namespace talus::tools::batch
