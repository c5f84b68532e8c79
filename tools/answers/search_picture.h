#pragma once
// The blocks of a search: those that fail in colours, moved as they fail.

#include <string>

#include "talus/formats/scenario.h"
#include "talus/searches.h"

namespace talus::tools {

/// As SVG: in section where the model is one, else seen obliquely. Fixed blocks are grey, those that fail
/// have a colour for each group. Motions are enlarged so that they show.
std::string searchPicture(const LoadSearch& search, const SearchResult& result,
                          const formats::Scenario& scenario);

}  // namespace talus::tools
