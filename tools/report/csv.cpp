#include "report/csv.h"

#include <array>
#include <charconv>
#include <cmath>

namespace talus::tools {

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
    for (std::string& field : fields) field = formats::csvText(std::move(field));
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
