#pragma once
// Files that a search draws beside its answer: the curve of load against displacement, and the blocks that
// fail.

#include <optional>
#include <string>
#include <vector>

#include "cli/failures.h"
#include "cli/json_fwd.h"
#include "talus/formats/scenario.h"
#include "talus/searches.h"

namespace CLI {
class App;
}

namespace talus::tools {

struct SearchFiles {
    std::string plot, picture;  ///< empty: not drawn
};

/// Adds --plot and --picture to a subcommand.
void addSearchFiles(CLI::App& app, SearchFiles& files);

/// Before a search of minutes. Throws BadInput for a name that is not a picture's or is given twice, and
/// FileRefused for one that cannot be written.
void refuseSearchFiles(const SearchFiles& files);

/// A file that was drawn, or why there is none.
struct DrawnFile {
    const char* key = "";  ///< in JSON, and in text
    std::string file, reason;
    int exit_code = kDone;
};

/// Draws the wanted files. Errors are part of the result, so that the answer is not lost.
std::vector<DrawnFile> drawSearchFiles(const SearchFiles& files, const LoadSearch& search,
                                       const SearchResult& result, const formats::Scenario& scenario);

Json drawnFileJson(const DrawnFile& drawn);  ///< {file, reason}

}  // namespace talus::tools
