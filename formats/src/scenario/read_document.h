#pragma once
// A scenario out of a parsed document, which may have been edited since.

#include <functional>
#include <string>
#include <vector>

#include "scenario/reading.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"

namespace talus::formats::scenario {

/// The tables and keys at the top of a scenario.
std::vector<std::string> scenarioSections();

/// As parseScenario; `text` is stored as the result's text. `questions` records the queries of the document.
Result<Scenario> readDocument(const Document& document, std::string text, const std::string& path,
                              std::int64_t most_blocks = kMostBlocks, const std::atomic<bool>* stop = nullptr,
                              Questions* questions = nullptr,
                              const std::function<void(const Progress&)>& progress = {});

}  // namespace talus::formats::scenario
