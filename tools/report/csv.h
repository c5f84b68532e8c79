#pragma once
// Lines of CSV (RFC 4180), each a row: no field contains a line break, so that a row is whole or absent after
// a crash.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "talus/formats/csv.h"

namespace talus::tools {

using formats::csvField;

std::string csvLine(const std::vector<std::string>& fields);  ///< with its line feed
std::vector<std::string> csvFields(std::string_view line);    ///< of a line without its line feed

/// The shortest text that reads back as the same number; "" when it is not finite.
std::string csvNumber(double value);

/// Nothing unless the whole field is a number.
std::optional<double> numberIn(std::string_view field);

}  // namespace talus::tools
