#pragma once
// The result of a search for a load, for people and as JSON.

#include <optional>
#include <string>

#include "answers/search_files.h"
#include "cli/common.h"
#include "cli/json_fwd.h"
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
    /// Interrupted after the search: the answer stands, what belongs beside it may lack.
    bool cut_short = false;
};

int exitCode(const SearchReport& report);

Json searchJson(const SearchReport& report);

/// A table for people; with `verbose` also each probe and each block's motion.
std::string searchText(const SearchReport& report, bool verbose);

}  // namespace talus::tools
