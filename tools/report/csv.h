#pragma once
// Lines of CSV (RFC 4180), each a row: what is in a field never breaks a line, which is what makes a row whole or absent
// after a crash.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace talus::tools {

/// Quoted when it holds a comma, a quote or a line break; line breaks become spaces. What a spreadsheet would take for a
/// formula (it begins with =, +, - or @ and is no number) gets an apostrophe in front, which csvFields takes off again.
std::string csvField(std::string_view field);

std::string csvLine(const std::vector<std::string>& fields);  ///< with its line feed
std::vector<std::string> csvFields(std::string_view line);    ///< of a line without its line feed

/// The shortest text that reads back as the same number; "" when it is not finite.
std::string csvNumber(double value);

/// Nothing unless the whole field is a number.
std::optional<double> numberIn(std::string_view field);

}  // namespace talus::tools
