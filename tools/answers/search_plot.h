#pragma once
// The curve of a search: load against displacement, with its answer, as a plot.

#include <string>

#include "report/figures.h"
#include "talus/searches.h"

namespace talus::tools {

/// \pre the result has a path
/// \param scenario  in the title
/// \param failure failure displacement between neighbours [m]
Plot searchPlot(const LoadSearch& search, const SearchResult& result, const std::string& scenario,
                double failure);

/// That displacement [m].
double failureDisplacement(const SearchResult& result, const Model& model);

}  // namespace talus::tools
