#include "files/csv_line.h"

#include <algorithm>

namespace talus::formats {

namespace {

std::string nameOf(char separator) {
    return separator == '\t' ? "tabs" : separator == ';' ? "semicolons" : "commas";
}

/// "-1,5e3" as much of Europe writes it.
bool hasDecimalComma(std::string_view cell) {
    const auto comma = cell.find(',');
    if (comma == std::string_view::npos || cell.find(',', comma + 1) != std::string_view::npos) return false;
    const auto of_number = [](char c) {
        return (c >= '0' && c <= '9') || c == ',' || c == '+' || c == '-' || c == 'e' || c == 'E';
    };
    return std::all_of(cell.begin(), cell.end(), of_number);
}

/// The text of a quoted cell from behind its first quote on; moves `at` behind its last one.
std::string quotedText(std::string_view line, std::size_t& at, bool& closed) {
    std::string text;
    for (; at < line.size(); ++at) {
        if (line[at] == '"' && !line.substr(at).starts_with("\"\"")) {
            ++at;
            return text;
        }
        if (line[at] == '"') ++at;
        text += line[at];
    }
    closed = false;
    return text;
}

}  // namespace

CsvLines::CsvLines(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);  // spreadsheets write it
}

bool CsvLines::next() {
    while (!rest_.empty()) {
        line_ = rest_.substr(0, rest_.find('\n'));
        rest_.remove_prefix(std::min(line_.size() + 1, rest_.size()));
        ++number_;
        const std::string_view bare = withoutBlanks(line_);
        if (!bare.empty() && bare.front() != '#') return true;
    }
    return false;
}

std::vector<CsvCell> cellsOf(std::string_view line, char separator) {
    std::vector<CsvCell> cells;
    for (std::size_t at = 0; at <= line.size(); ++at) {
        at = std::min(line.find_first_not_of(' ', at), line.size());
        CsvCell& cell = cells.emplace_back();
        cell.column = static_cast<int>(at) + 1;
        cell.quoted = at < line.size() && line[at] == '"';
        if (cell.quoted) cell.text = quotedText(line, ++at, cell.closed);
        const std::size_t end = std::min(line.find(separator, at), line.size());
        if (!cell.quoted) cell.text = withoutBlanks(line.substr(at, end - at));
        at = end;
    }
    return cells;
}

std::string rowFault(const std::vector<CsvCell>& cells, std::size_t columns, char separator,
                     bool decimal_comma) {
    for (const CsvCell& cell : cells) {
        if (!cell.closed) return "found a quote that does not end on its line";
        if (std::string wrong = cell.quoted ? "" : cellFault(cell.text, separator, decimal_comma);
            !wrong.empty())
            return wrong;
    }
    if (cells.size() == columns) return "";
    return "found " + std::to_string(cells.size()) + " values, allowed: " + std::to_string(columns) +
           ", one for each column";
}

std::string_view withoutBlanks(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return "";
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

char separatorOf(std::string_view header) {
    std::string bare;
    bool quoted = false;
    for (const char c : header) {
        if (c == '"') quoted = !quoted;
        if (!quoted) bare += c;
    }
    for (const char candidate : {'\t', ';'})
        if (bare.find(candidate) != std::string::npos) return candidate;
    return ',';
}

std::string cellFault(std::string_view cell, char separator, bool decimal_comma) {
    if (!decimal_comma && separator != ',' && hasDecimalComma(cell))
        return "found \"" + std::string(cell) + "\", allowed: numbers with a decimal point";
    for (const char other : {'\t', ';'})
        if (other != separator && cell.find(other) != std::string_view::npos)
            return "found " + nameOf(other) + " between values, allowed: " + nameOf(separator) +
                   ", as in the header";
    return "";
}

}  // namespace talus::formats
