#pragma once
// An answer of a search with all secondary results: computed by `talus critical-angle` and the other
// searches, and returned by Python's functions of those names.

#include "answers/search_report.h"

namespace talus::tools {

/// Secondary results to compute.
struct SearchRequest {
    int groups = 1;  ///< most groups to follow
    KeepRunOptions keep{};
    SearchFiles files{};
    Beside upper_bound = Beside::by_size;  ///< of limit analysis
    bool interval = true;                  ///< look for lower answers, too
};

/// Searches and keeps the failing run if wanted. Objects that the report refers to must outlive it. Throws
/// BadInput, FileRefused.
SearchReport answer(const LoadSearch& search, const formats::Scenario& scenario, const SearchRequest& request,
                    const Common& common, Control control);

}  // namespace talus::tools
