#include "reproduction/scenario_text.h"

#include <sstream>
#include <vector>

namespace talus::tools {
namespace {

std::string_view trimmed(std::string_view line) {
    const auto begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return {};
    return line.substr(begin, line.find_last_not_of(" \t\r") - begin + 1);
}

std::vector<std::string> linesOf(std::string_view text) {
    std::istringstream stream{std::string(text)};
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + '\n';
    return text;
}

bool isHeader(std::string_view line) { return trimmed(line).starts_with('['); }

bool isHeader(std::string_view line, std::string_view header) {
    const std::string_view content = trimmed(line.substr(0, line.find('#')));
    return content == header;
}

bool sets(std::string_view line, std::string_view key) {
    const auto equals = line.find('=');
    return equals != std::string_view::npos && trimmed(line.substr(0, equals)) == key;
}

/// "  # comment" at the end of a line, else nothing. The scenarios built in have no '#' inside a string.
std::string commentOf(std::string_view line) {
    const auto hash = line.find('#');
    return hash == std::string_view::npos ? std::string() : "  " + std::string(line.substr(hash));
}

}  // namespace

std::string withValue(std::string_view scenario, std::string_view header, std::string_view key,
                      std::string_view value) {
    std::vector<std::string> lines = linesOf(scenario);
    const std::string setting = std::string(key) + " = " + std::string(value);
    std::size_t table = 0;
    while (table < lines.size() && !isHeader(lines[table], header)) ++table;
    if (table == lines.size()) return joined(lines) + '\n' + std::string(header) + '\n' + setting + '\n';
    for (std::size_t line = table + 1; line < lines.size() && !isHeader(lines[line]); ++line) {
        if (!sets(lines[line], key)) continue;
        lines[line] = setting + commentOf(lines[line]);
        return joined(lines);
    }
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(table) + 1, setting);
    return joined(lines);
}

}  // namespace talus::tools
