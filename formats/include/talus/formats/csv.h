#pragma once
// Fields of CSV files (RFC 4180) that this project writes.

#include <string>
#include <string_view>

namespace talus::formats {

/// Quoted when it holds a comma, a quote or a line break; line breaks become spaces. A text that a
/// spreadsheet would read as a formula (begins with =, +, - or @ and is no number) gets an apostrophe in
/// front.
std::string csvField(std::string_view field);

/// Without the apostrophe that csvField puts there.
std::string csvText(std::string field);

}  // namespace talus::formats
