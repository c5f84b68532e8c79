#pragma once
// The answer of a search with all secondary results, before it becomes text or JSON.

#include <optional>
#include <vector>

#include "answers/search_files.h"
#include "cli/common.h"
#include "recording/keep_run.h"
#include "talus/formats/scenario.h"
#include "talus/searches.h"

namespace talus::tools {

/// Everything a search's output is made from.
struct SearchReport {
    const Common& common;
    const formats::Scenario& scenario;
    const LoadSearch& search;
    SearchResult result;
    std::optional<TheoryFigure> theory;
    std::optional<KeptRun> kept{};   ///< with --keep-run
    std::vector<DrawnFile> drawn{};  ///< with --plot and --picture
    /// Interrupted after the search: the answer is valid, secondary results may be missing.
    bool cut_short = false;
};

}  // namespace talus::tools
