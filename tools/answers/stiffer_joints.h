#pragma once
// The answer for a slope in the shape it was built in, where its joints are so soft that it changes that shape on the way.
//
// A search follows the blocks from rest to rest. Columns on soft joints that dip into the slope lean by some hundredths of their
// width before they fail, come to stand on ledges that were none, and lean on. What stands so is balanced, and limit
// analysis of that shape agrees; but its ceiling is of the shape as built, where nothing stands above it, however stiff the
// joints. Statics of rigid blocks does not depend on stiffness, so the same search with joints so stiff that the blocks stay
// where they are answers for that shape.

#include <functional>

#include "answers/ceiling.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"
#include "talus/limit_analysis.h"
#include "talus/result.h"
#include "talus/searches.h"

namespace talus::tools {

/// An answer with its ceiling, and what was made of the joints for it.
struct CeiledAnswer {
    SearchResult result;
    Ceiling ceiling{};
    double stiffness = 1;  ///< of the joints, over the scenario's
};

/// The ceiling of an answer to a scenario.
using CeilingOf = std::function<Ceiling(const formats::Scenario&, const SearchResult&)>;

/// An answer as it is when it is not above its ceiling; else that of stiffer joints, with a warning that says both. Where that is not
/// found below its ceiling, either, the answer given is wrong: undecided, and a warning says so.
/// Costs of both are in the answer.
CeiledAnswer heldUnderCeiling(const LoadSearch& search, const formats::Scenario& scenario,
                              SearchResult result, const CeilingOf& ceiling_of, const Control& control);

/// What a search finds, held under its ceiling. Errors: those of the search. Throws BadInput.
Result<CeiledAnswer> findUnderCeiling(const LoadSearch& search, const formats::Scenario& scenario,
                                      const CeilingOptions& options, const Control& control);

}  // namespace talus::tools
