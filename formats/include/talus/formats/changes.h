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
    /// an integer, a number, true or false; an array in [], a table in {} or a text in double quotes as in
    /// TOML, with its escapes; any other text literally
    std::string value;
};

/// Name used in messages instead of the file for errors in changed fields.
inline constexpr const char* kChangedBy = "--set";

/// As readScenario, with changes. Errors of changed fields name kChangedBy in place of the file, also those
/// of the engine (placed): in Scenario::places they have line 0. The scenario's text contains the values. The
/// path "-" is the standard input, called "stdin" in messages; files it names are looked for in the current
/// folder. \param progress told how far the cutting of a rock mass has come
Result<Scenario> readScenario(const std::string& path, const std::vector<FieldChange>& changes,
                              const std::atomic<bool>* stop = nullptr,
                              const std::function<void(const Progress&)>& progress = {});

}  // namespace talus::formats
