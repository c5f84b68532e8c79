#pragma once
// A search: up the equilibrium path of a load, from a beginning that all searches share, to the failure that
// counts.

#include "search/load_axis.h"
#include "talus/analysis.h"

namespace talus::search {

/// One of the three searches.
Result<SearchResult> searchFor(Varied varied, const Model& model, const Control& control,
                               const SearchRules& rules);

}  // namespace talus::search
