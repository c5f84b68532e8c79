#pragma once
// The queries of the reader of sweeps.

#include "talus/formats/scenario.h"
#include "toml/document.h"
#include "toml/questions.h"

namespace talus::formats::sweep {

/// Reads a document for its questions alone, with a scenario in place of the file it names.
void questionsOf(const toml::Document& document, const Scenario& scenario, toml::Questions& questions);

}  // namespace talus::formats::sweep
