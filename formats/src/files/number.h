#pragma once
// Numbers in words of text files.

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace talus::formats {

/// A finite number that fills the whole word.
inline std::optional<double> numberOf(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
    if (read.ec != std::errc() || read.ptr != word.data() + word.size() || !std::isfinite(value)) return {};
    return value;
}

}  // namespace talus::formats
