#pragma once
// What critical-angle and safety-factor have in common: the result of a search, for people and as JSON.

#include <optional>
#include <string>

#include "cli/command.h"
#include "recording/keep_run.h"
#include "talus/analysis.h"
#include "talus/limit_analysis.h"
#include "talus/theory.h"

namespace talus::tools {

/// How a search's load is called and printed.
struct LoadName {
    const char* title = "";      ///< "critical angle"
    const char* probe_key = "";  ///< key of a probe's load in JSON: "tilt_deg"
    const char* unit = "";       ///< " deg" or ""
    double scale = 1;            ///< of the printed figure: SI value over it
    int decimals = 3;
};

/// The closed formulas' figure, in the load's SI unit, and the words that go with it.
struct TheoryFigure {
    double value = 0;
    theory::Prediction prediction;
};

/// Everything a search's output is made from.
struct SearchReport {
    const Common& common;
    const formats::Scenario& scenario;
    const SearchResult& result;
    LoadName load;
    std::optional<TheoryFigure> theory;
    Ceiling ceiling{};
    std::optional<KeptRun> kept{};  ///< with --keep-run
};

std::string statusText(SearchStatus status);  ///< as in JSON; "undecided" when interrupted
bool wasInterrupted(const SearchResult& result);
int exitCode(const SearchReport& report);

Json answerJson(const SearchReport& report);   ///< the answer, null unless found
Json bracketJson(const SearchReport& report);  ///< [low, high], null at an open end
Json theoryJson(const SearchReport& report);   ///< {formula, mode, applies_because} or null

/// Adds the keys both commands have after the answer, its bracket and the theory.
void addSearchJson(Json& json, const SearchReport& report);

/// A table for people; with `verbose` also each probe and each block's motion.
std::string searchText(const SearchReport& report, bool verbose);

}  // namespace talus::tools
