#pragma once
// JSON Schemas (draft 7) of the files that are read, for editors that complete and check keys. They are
// generated from the readers' own queries of a document, so the two cannot differ. The reader alone checks
// conditions on other values (the number of a stack's heights) and combinations of keys.

#include <string>

namespace talus::formats {

std::string scenarioSchema();
std::string sweepSchema();

}  // namespace talus::formats
