#include "cli/terminal.h"

#include <sys/ioctl.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <sstream>

namespace talus::tools {

namespace {

constexpr std::size_t kLeast = 20;

/// One line of source text, its own spaces in front kept.
void wrapLine(const std::string& line, std::size_t width, std::size_t indent, std::string& out) {
    const std::size_t own = std::min(line.find_first_not_of(' '), line.size());
    const std::size_t further = indent + own + (own > 0 ? 4 : 0);
    std::size_t column = indent + own;
    out += std::string(column, ' ');
    std::istringstream words(line);
    bool first = true;
    for (std::string word; words >> word; first = false) {
        if (!first && column + 1 + word.size() > width) {
            out += "\n" + std::string(further, ' ');
            column = further;
        } else if (!first) {
            out += ' ';
            ++column;
        }
        out += word;
        column += word.size();
    }
    out += '\n';
}

}  // namespace

std::size_t columnsOf(int stream, std::size_t otherwise) {
    std::size_t columns = 0;
    if (const char* said = std::getenv("COLUMNS")) std::from_chars(said, said + std::strlen(said), columns);
    winsize size{};
    if (columns == 0 && ioctl(stream, TIOCGWINSZ, &size) == 0) columns = size.ws_col;
    return columns > 0 ? std::max(columns, kLeast) : otherwise;
}

std::string wrapped(const std::string& text, std::size_t width, std::size_t indent) {
    std::string out, paragraph;
    const auto flush = [&] {
        if (!paragraph.empty()) wrapLine(paragraph, width, indent, out);
        paragraph.clear();
    };
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const bool plain = !line.empty() && line.front() != ' ';
        if (plain && !paragraph.empty() && paragraph.front() != ' ') {
            paragraph += ' ' + line;
            continue;
        }
        flush();
        if (line.empty()) out += '\n';
        paragraph = line;
    }
    flush();
    return out;
}

}  // namespace talus::tools
