#pragma once
// The ceiling of limit analysis beside the answer of a search.

#include <optional>
#include <string>

#include "talus/formats/scenario.h"
#include "talus/limit_analysis.h"

namespace CLI {
class App;
}

namespace talus::tools {

/// A load for people: "19.512 deg", "factor 1.0133". \param value  in its SI unit
std::string shortLoadText(double value, Varied load);

/// --ceiling, --no-ceiling; neither: up to a model size.
struct CeilingOptions {
    bool always = false, never = false;
};

void addCeiling(CLI::App& app, CeilingOptions& options);

/// A search's ceiling; without value when it is not wanted or the search was interrupted.
Ceiling findCeiling(const formats::Scenario& scenario, Varied load, const CeilingOptions& options,
                    const SearchResult& result, const Control& control);

/// An answer above the ceiling is wrong, whatever led to it: it becomes undecided, and a warning says both figures.
void holdUnder(const Ceiling& ceiling, Varied load, SearchResult& result);

}  // namespace talus::tools
