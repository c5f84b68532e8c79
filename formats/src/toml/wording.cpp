#include "toml/wording.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace talus::formats::toml {

namespace {

constexpr std::size_t kLongestQuote = 60;
constexpr std::size_t kLongestList = 28;      // [[water]] has 25 keys, the most of all tables
constexpr std::size_t kLongestCompared = 80;  // longer texts are no typing errors

std::string lowered(std::string_view text) {
    std::string lower(text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

/// Optimal string alignment distance, in three rolling rows.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        std::swap(before, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

bool continues(std::string_view longer, std::string_view shorter) {
    return shorter.size() >= 3 && longer.substr(0, shorter.size()) == shorter;
}

/// Edits between two texts in lower case. The second may lose its last part for one more edit ("duraton" for
/// "duration_s"). A text that continues the other is one edit away.
std::size_t distance(const std::string& found, const std::string& candidate) {
    if (found == candidate) return 0;
    if (continues(found, candidate) || continues(candidate, found)) return 1;
    const std::size_t edits = editDistance(found, candidate);
    const auto last_part = candidate.rfind('_');
    if (last_part == std::string::npos) return edits;
    return std::min(edits, 1 + editDistance(found, std::string_view(candidate).substr(0, last_part)));
}

bool isBareKey(std::string_view key) {
    return !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-';
    });
}

}  // namespace

std::string numberText(double value) {
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
    const double size = std::abs(value);
    const auto style =
        value == 0 || (size >= 1e-4 && size < 1e9) ? std::chars_format::fixed : std::chars_format::general;
    std::array<char, 64> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, style).ptr;
    return std::string(buffer.data(), end);
}

std::string oneLine(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    return text;
}

std::string quoted(std::string_view text) {
    std::string shown(text.substr(0, kLongestQuote));
    // Do not cut a UTF-8 sequence in two: drop the bytes of an unfinished character.
    if (text.size() > kLongestQuote && (static_cast<unsigned char>(text[kLongestQuote]) & 0xC0) == 0x80) {
        while (!shown.empty() && (static_cast<unsigned char>(shown.back()) & 0xC0) == 0x80) shown.pop_back();
        if (!shown.empty()) shown.pop_back();
    }
    return '"' + oneLine(std::move(shown)) + (text.size() > kLongestQuote ? "...\"" : "\"");
}

std::string listed(const std::vector<std::string>& names) {
    if (names.empty()) return "none";
    std::string list;
    for (std::size_t i = 0; i < std::min(names.size(), kLongestList); ++i)
        list +=
            (i ? ", " : "") + (isBareKey(names[i]) ? names[i].substr(0, kLongestCompared) : quoted(names[i]));
    return names.size() > kLongestList ? list + ", ..." : list;
}

std::string joinField(std::string_view parent, std::string_view key) {
    const std::string shown =
        isBareKey(key) && key.size() <= kLongestCompared ? std::string(key) : quoted(key);
    return parent.empty() ? shown : std::string(parent) + "." + shown;
}

std::string elementField(std::string_view parent, std::size_t index) {
    return std::string(parent) + "[" + std::to_string(index) + "]";
}

std::optional<std::string> nearest(std::string_view found, const std::vector<std::string>& candidates) {
    if (found.empty() || found.size() > kLongestCompared) return std::nullopt;
    const std::string lower = lowered(found);
    const std::string* best = nullptr;
    std::size_t fewest = std::max<std::size_t>(1, found.size() / 3) + 1;
    for (const std::string& candidate : candidates) {
        if (candidate.size() > kLongestCompared) continue;
        const std::size_t edits = distance(lower, lowered(candidate));
        if (edits >= fewest) continue;
        fewest = edits;
        best = &candidate;
    }
    return best ? std::optional<std::string>(*best) : std::nullopt;
}

std::string suggestion(std::string_view found, const std::vector<std::string>& candidates) {
    if (const auto meant = nearest(found, candidates)) return ", did you mean " + quoted(*meant) + "?";
    return ", allowed: " + listed(candidates);
}

}  // namespace talus::formats::toml
