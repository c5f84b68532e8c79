#pragma once
// A search for a tilt in a model whose joints water weakens: repeated until what is wet is that of the answer
// (build/wet_tilt.h).

#include "talus/analysis.h"

namespace talus::search {

/// \pre hasWetJoints(model)
Result<SearchResult> findTiltOfWetJoints(const Model& model, const Control& control,
                                         const SearchRules& rules);

}  // namespace talus::search
