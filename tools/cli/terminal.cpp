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

/// Where the content of a line begins: behind its label, if there is one that leaves room.
std::size_t contentColumn(const std::string& line, std::size_t width) {
    constexpr std::size_t kFurther = 2;
    const std::size_t own = std::min(line.find_first_not_of(' '), line.size());
    const std::size_t gap = line.find("  ", own);
    const std::size_t content = gap == std::string::npos ? gap : line.find_first_not_of(' ', gap);
    if (content != std::string::npos && own == 0 && content <= width / 2) return content;
    return std::min(own > 0 ? own : kFurther, width / 2);
}

void fitLine(std::string line, std::size_t width, std::string& out) {
    const std::size_t content = contentColumn(line, width);
    for (std::size_t from = content; line.size() > width;) {
        std::size_t at = line.rfind(' ', width);
        if (at == std::string::npos || at < from) at = line.find(' ', std::max(width, from));
        if (at == std::string::npos) break;
        const std::size_t next = line.find_first_not_of(' ', at);
        if (next == std::string::npos) break;
        const std::size_t end = line.find_last_not_of(' ', at);
        out += line.substr(0, end == std::string::npos ? 0 : end + 1) + '\n';
        line = std::string(content, ' ') + line.substr(next);
        from = content + 1;
    }
    out += line;
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

std::string fitted(const std::string& text, std::size_t width) {
    std::string out;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t end = std::min(text.find('\n', from), text.size());
        fitLine(text.substr(from, end - from), width, out);
        if (end < text.size()) out += '\n';
        from = end + 1;
    }
    return out;
}

}  // namespace talus::tools
