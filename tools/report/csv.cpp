#include "report/csv.h"

#include <array>
#include <charconv>
#include <cmath>

namespace talus::tools {

namespace {

/// Apostrophes, then what a spreadsheet begins a formula with: so one apostrophe more or less loses nothing.
bool beginsAsFormula(std::string_view field) {
    const std::size_t first = field.find_first_not_of('\'');
    return first != std::string_view::npos &&
           std::string_view("=+-@\t").find(field[first]) != std::string_view::npos;
}

bool isHarmless(std::string_view field) { return !beginsAsFormula(field) || numberIn(field); }

}  // namespace

std::string csvField(std::string_view field) {
    const std::string mark = isHarmless(field) ? "" : "'";
    if (field.find_first_of(",\"\r\n") == std::string_view::npos) return mark + std::string(field);
    std::string quoted = "\"" + mark;
    for (const char c : field)
        quoted += c == '"' ? "\"\"" : c == '\n' || c == '\r' ? std::string(" ") : std::string(1, c);
    return quoted + '"';
}

std::string csvLine(const std::vector<std::string>& fields) {
    std::string line;
    for (std::size_t i = 0; i < fields.size(); ++i) line += (i > 0 ? "," : "") + csvField(fields[i]);
    return line + '\n';
}

std::vector<std::string> csvFields(std::string_view line) {
    std::vector<std::string> fields(1);
    bool inside = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && inside && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[i++];
        else if (c == '"')
            inside = !inside;
        else if (c == ',' && !inside)
            fields.emplace_back();
        else if (c != '\r')
            fields.back() += c;
    }
    for (std::string& field : fields)
        if (field.starts_with('\'') && beginsAsFormula(field)) field.erase(0, 1);
    return fields;
}

std::string csvNumber(double value) {
    if (!std::isfinite(value)) return "";
    std::array<char, 40> buffer;
    return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

std::optional<double> numberIn(std::string_view field) {
    double value = 0;
    const auto read = std::from_chars(field.data(), field.data() + field.size(), value);
    const bool whole = read.ec == std::errc() && read.ptr == field.data() + field.size() && !field.empty();
    return whole ? std::optional(value) : std::nullopt;
}

}  // namespace talus::tools
