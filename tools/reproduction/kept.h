#pragma once
// The failing runs that the paper's page shows: the slopes of its Figs. 4 (dry) and 5 (water in fissure 5).

#include <string>
#include <vector>

#include "reproduction/results.h"

namespace talus::tools {

/// Marks the cases whose failing run is to be kept, before they are computed.
void markKept(std::vector<PaperCase>& cases);

/// Continues them as runs and writes a snapshot file and a replay page for each into `folder`, replacing
/// existing ones. Paths in the result are relative to `page_folder`. Throws FileRefused.
void keepFailures(PaperResults& results, const std::string& folder, const std::string& page_folder,
                  const Common& common);

/// The path as a link on a page in `folder`.
std::string relativeTo(const std::string& folder, const std::string& path);

/// Its caption: "Columns 1-5 (75 blocks) slid; columns 6-7 (30 blocks) stayed."
std::string seenText(const KeptRun& kept);

/// The page's section: pictures with links to the replays, or how to get them.
Json keptSection(const PaperResults& results);

}  // namespace talus::tools
