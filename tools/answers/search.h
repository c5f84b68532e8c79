#pragma once
// An answer to a question about a scenario, with all that is said beside it: what `talus critical-angle` and
// its like compute and Python's functions of those names return.

#include "answers/search_report.h"

namespace talus::tools {

/// What is asked for beside the load.
struct SearchRequest {
    int groups = 1;  ///< most groups to follow
    KeepRunOptions keep{};
    SearchFiles files{};
    Beside upper_bound = Beside::by_size;  ///< of limit analysis
    bool interval = true;                  ///< look for lower answers, too
};

/// Searches and keeps the failing run when that is wanted. What the report refers to must outlive it. Throws
/// BadInput, FileRefused.
SearchReport answer(const LoadSearch& search, const formats::Scenario& scenario, const SearchRequest& request,
                    const Common& common, Control control);

}  // namespace talus::tools
