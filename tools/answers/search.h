#pragma once
// An answer to a question about a scenario, with all that is said beside it: what `talus critical-angle` and its like
// compute and Python's functions of those names return.

#include "answers/ceiling.h"
#include "answers/search_report.h"

namespace talus::tools {

/// Contact points of models whose searches also try another loading history: a tenth to two thirds of a search more.
inline constexpr std::size_t kMostPointsOfRange = 15'000;

/// Whether another loading history is tried; neither: up to a model size.
struct RangeOptions {
    bool always = false, never = false;
};

/// What is asked for beside the load.
struct SearchRequest {
    int groups = 1;  ///< most groups to follow
    KeepRunOptions keep{};
    CeilingOptions ceiling{};
    RangeOptions range{};
};

/// Searches, puts limit analysis beside the answer and keeps the failing run when that is wanted. What the report refers
/// to must outlive it. Throws BadInput, FileRefused.
SearchReport answer(const LoadSearch& search, const formats::Scenario& scenario, const SearchRequest& request,
                    const Common& common, Control control);

}  // namespace talus::tools
