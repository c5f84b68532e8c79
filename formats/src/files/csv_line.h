#pragma once
// Lines of tables that people make with spreadsheets.

#include <string>
#include <string_view>

namespace talus::formats {

/// Without the blanks, tabs and carriage return around it.
std::string_view withoutBlanks(std::string_view text);

/// What stands between the columns of a table with this header: a tab, a semicolon or a comma, in quotes none of them.
char separatorOf(std::string_view header);

/// Why this cell, which stands without quotes in a table with this separator, cannot be what is meant: another separator
/// than the header's, or a comma for a decimal point. Nothing when it can.
std::string cellFault(std::string_view cell, char separator);

}  // namespace talus::formats
