#pragma once
// Fields of a scenario that are given other values than its file has.

#include <vector>

#include "scenario/reading.h"
#include "talus/formats/scenario.h"

namespace talus::formats::scenario {

/// Puts the values into the document; faults of paths that lead nowhere.
std::vector<Error> change(Document& document, const std::vector<FieldChange>& changes);

/// Errors of changed fields are said of who changed them: the file has no such line.
std::vector<Error> ofChanges(const std::vector<FieldChange>& changes, std::vector<Error> errors);

}  // namespace talus::formats::scenario
