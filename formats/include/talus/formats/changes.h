#pragma once
// Scenario files read with other values in some of their fields.

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "talus/analysis.h"
#include "talus/formats/scenario.h"

namespace talus::formats {

/// A field that is to have another value than its file gives; it may be one that the file leaves out.
struct FieldChange {
    std::string field;  ///< as a user writes it: water[0].depth
    /// an integer, a number, true or false; an array in [], a table in {} or a text in double quotes as TOML
    /// writes them, with its escapes; else text as it stands
    std::string value;
};

/// What messages name in place of the file where a changed field is wrong.
inline constexpr const char* kChangedBy = "--set";

/// As readScenario without changes, but that faults of changed fields name kChangedBy in place of the file,
/// the engine's too (placed): in Scenario::places they have line 0. The text of the scenario has the values
/// in it. The path "-" is the standard input, called "stdin" in messages; files it names are looked for in
/// the current folder. \param progress  told how far the cutting of a rock mass has come
Result<Scenario> readScenario(const std::string& path, const std::vector<FieldChange>& changes,
                              const std::atomic<bool>* stop = nullptr,
                              const std::function<void(const Progress&)>& progress = {});

}  // namespace talus::formats
