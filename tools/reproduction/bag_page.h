#pragma once
// The water bag on the paper's page.

#include <string>

#include "cli/common.h"
#include "cli/json_fwd.h"

namespace talus::tools {

struct PaperResults;

/// The three runs of the slope with water in fissure 5, with a snapshot file and a replay page each in
/// `folder`, replacing what is there. No runs without an answer for that slope. Throws FileRefused.
void keepBagRuns(PaperResults& results, const std::string& folder, const std::string& page_folder,
                 const Common& common);

/// The page's section: what is assumed, table, plots and links, or how to get them.
Json bagSection(const PaperResults& results);

}  // namespace talus::tools
