#include <charconv>

#include "talus/formats/csv.h"

namespace talus::formats {

namespace {

/// Apostrophes, then what a spreadsheet begins a formula with: so one apostrophe more or less loses nothing.
bool beginsAsFormula(std::string_view field) {
    const std::size_t first = field.find_first_not_of('\'');
    return first != std::string_view::npos &&
           std::string_view("=+-@\t").find(field[first]) != std::string_view::npos;
}

bool isNumber(std::string_view field) {
    double value = 0;
    const auto read = std::from_chars(field.data(), field.data() + field.size(), value);
    return read.ec == std::errc() && read.ptr == field.data() + field.size();
}

}  // namespace

std::string csvField(std::string_view field) {
    const std::string mark = beginsAsFormula(field) && !isNumber(field) ? "'" : "";
    if (field.find_first_of(",\"\r\n") == std::string_view::npos) return mark + std::string(field);
    std::string quoted = "\"" + mark;
    for (const char c : field)
        quoted += c == '"' ? "\"\"" : c == '\n' || c == '\r' ? std::string(" ") : std::string(1, c);
    return quoted + '"';
}

std::string csvText(std::string field) {
    if (field.starts_with('\'') && beginsAsFormula(field)) field.erase(0, 1);
    return field;
}

}  // namespace talus::formats
