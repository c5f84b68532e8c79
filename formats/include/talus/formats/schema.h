#pragma once
// JSON Schemas (draft 7) of the files that are read, for editors that complete and check keys. They are made
// of what the readers ask of a document, so they cannot say anything else. What depends on other values (how
// many heights a stack has) and which keys go together is the reader's to check.

#include <string>

namespace talus::formats {

std::string scenarioSchema();
std::string sweepSchema();

}  // namespace talus::formats
