#pragma once
// Plots and drawings as SVG files for documents, with the colours of print built in. The page draws the same
// data itself; histograms, heat maps and correlations exist on the page only.

#include <string>

#include "report/figures.h"

namespace talus::tools {

/// A plot of lines, points, bands, boxes and labels, both axes with their domain and their step or names.
/// \param titled with its title above it, for a file without a caption
std::string svgFile(const Plot& plot, bool titled = false);

std::string svgFile(const Drawing& drawing);

/// A step of 1, 2 or 5 times a power of ten that cuts the span into about `count` parts.
double niceStep(double span, int count);

/// An axis over values from low to high: its ends are ticks, some `count` steps apart.
PlotAxis axisOver(std::string title, double low, double high, int count);

}  // namespace talus::tools
