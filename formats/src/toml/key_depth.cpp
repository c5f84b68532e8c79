#include "toml/key_depth.h"

#include <algorithm>
#include <string>

namespace talus::formats::toml {

namespace {

/// \pre text[at] is a quote. Position behind the string that starts there: single or triple quoted, basic
/// strings with escapes. An unfinished single-quoted string ends with its line (the parser will refuse it).
std::size_t skipString(std::string_view text, std::size_t at) {
    const char quote = text[at];
    const bool basic = quote == '"';
    const bool multi_line = text.substr(at, 3) == std::string_view(basic ? "\"\"\"" : "'''");
    at += multi_line ? 3 : 1;
    while (at < text.size()) {
        if (basic && text[at] == '\\') {
            at += 2;
        } else if (text[at] == '\n' && !multi_line) {
            return at;
        } else if (text[at] != quote) {
            ++at;
        } else if (!multi_line) {
            return at + 1;
        } else if (text.substr(at, 3) != std::string(3, quote)) {
            ++at;
        } else {
            // Up to two quotes may stand directly before the closing three.
            at += 3;
            for (int extra = 0; extra < 2 && at < text.size() && text[at] == quote; ++extra) ++at;
            return at;
        }
    }
    return text.size();
}

Place placeAt(std::string_view text, std::size_t at) {
    const std::string_view before = text.substr(0, at);
    const auto line_start = before.rfind('\n');
    return {1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
            static_cast<int>(line_start == std::string_view::npos ? at : at - line_start - 1) + 1};
}

}  // namespace

std::optional<Place> tooDeepKey(std::string_view text) {
    constexpr std::string_view kEndsKey = "=,\n[]{}";
    int dots = 0;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (c == '"' || c == '\'') {
            at = skipString(text, at);
            continue;
        }
        if (c == '#') {
            at = std::min(text.find('\n', at), text.size());
            continue;
        }
        if (c == '.' && ++dots >= kMaxKeyDepth) return placeAt(text, at);
        if (kEndsKey.find(c) != std::string_view::npos) dots = 0;
        ++at;
    }
    return std::nullopt;
}

}  // namespace talus::formats::toml
