#pragma once
// Tables made with spreadsheets: their lines, and the cells of a line.

#include <string>
#include <string_view>
#include <vector>

namespace talus::formats {

/// The lines of a table that are neither empty nor comments (#), the header first.
class CsvLines {
 public:
    explicit CsvLines(std::string_view text);  ///< a byte order mark at its begin is passed over

    bool next();                                     ///< false at the end
    std::string_view line() const { return line_; }  ///< as it stands, without its end
    int number() const { return number_; }           ///< in the file, from 1

 private:
    std::string_view rest_, line_{};
    int number_ = 0;
};

/// The text between two separators: without surrounding blanks, or within quotes (RFC 4180).
struct CsvCell {
    std::string text;
    bool quoted = false, closed = true;  ///< closed: by a quote, if it began with one
    int column = 1;                      ///< of its first character, from 1
};
std::vector<CsvCell> cellsOf(std::string_view line, char separator);

/// Why these cells are no row of a table with so many columns; nothing when they are. \param decimal_comma
/// whether numbers may have a comma
std::string rowFault(const std::vector<CsvCell>& cells, std::size_t columns, char separator,
                     bool decimal_comma = false);

/// Without the blanks, tabs and carriage return around it.
std::string_view withoutBlanks(std::string_view text);

/// The separator of a table with this header: a tab, a semicolon or a comma outside of quotes.
char separatorOf(std::string_view header);

/// Why an unquoted cell cannot be as intended in a table with this separator: another separator than the
/// header's, or a decimal comma. Nothing when it can.
std::string cellFault(std::string_view cell, char separator, bool decimal_comma = false);

}  // namespace talus::formats
