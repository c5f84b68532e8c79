#pragma once
// A whole text file, within reason.

#include <string>

#include "talus/result.h"

namespace talus::formats::toml {

/// Errors name the file: it cannot be opened, is a directory, cannot be read, or is larger than 64 MiB.
Result<std::string> readFileText(const std::string& path);

/// The same of the standard input, which messages call `name`.
Result<std::string> readStandardInput(const std::string& name);

}  // namespace talus::formats::toml
