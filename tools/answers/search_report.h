#pragma once
// The result of a search for a load, as text and JSON.

#include <string>

#include "answers/search_answer.h"
#include "cli/json_fwd.h"

namespace talus::tools {

int exitCode(const SearchReport& report);

Json searchJson(const SearchReport& report);

/// A table of text; with `verbose` also each probe and each block's motion.
std::string searchText(const SearchReport& report, bool verbose);

}  // namespace talus::tools
