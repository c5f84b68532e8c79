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

}  // namespace

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

std::string cellFault(std::string_view cell, char separator) {
    if (separator != ',' && hasDecimalComma(cell))
        return "found \"" + std::string(cell) + "\", allowed: numbers with a decimal point";
    for (const char other : {'\t', ';'})
        if (other != separator && cell.find(other) != std::string_view::npos)
            return "found " + nameOf(other) + " between values, allowed: " + nameOf(separator) +
                   ", as in the header";
    return "";
}

}  // namespace talus::formats
