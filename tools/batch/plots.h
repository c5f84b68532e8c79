#pragma once
// The plots of a batch's page.

#include <string>
#include <vector>

#include "batch/summary.h"
#include "report/figures.h"

namespace talus::tools::batch {

/// Histogram of the answers.
Plot plotHistogram(const Summary& summary);

/// Share of the runs that have failed, against the answer, with the confidence band of each point.
Plot plotDistribution(const Summary& summary);

/// Convergence of the probability of failure at a threshold with the number of runs, in the order of their
/// samples.
Plot plotConvergence(const Summary& summary, std::size_t threshold);

/// Convergence of the mean answer, with Student's interval.
Plot plotMeanConvergence(const Summary& summary);

/// What was drawn for one column that varies.
Plot plotInput(const Summary& summary, std::size_t value);

/// Rank correlation of the answer with the varied columns, the strongest on top.
Plot plotCorrelations(const Summary& summary);

/// The answer against one column that varies: every run, and the mean at each value when there are few
/// values.
Plot plotResponse(const Summary& summary, std::size_t value);

/// Mean answer over two columns with few values each.
Plot plotHeatMap(const Summary& summary, std::size_t x_value, std::size_t y_value);

/// Distinct values of a column among the runs with a finite answer, sorted.
std::vector<double> valuesOf(const Summary& summary, std::size_t value);

/// "critical angle below 12°"
std::string thresholdText(const BatchInfo& info, double threshold);

}  // namespace talus::tools::batch
