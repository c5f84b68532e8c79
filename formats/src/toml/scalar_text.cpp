#include "toml/scalar_text.h"

#include <charconv>
#include <optional>

namespace talus::formats::toml {

namespace {

template <class T>
std::optional<T> readWhole(std::string_view text) {
    T value{};
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

Scalar scalarOf(std::string_view text) {
    if (text == "true" || text == "false") return text == "true";
    const std::string_view unsigned_text = text.starts_with('+') ? text.substr(1) : text;
    if (const auto integer = readWhole<std::int64_t>(unsigned_text)) return *integer;
    if (const auto real = readWhole<double>(unsigned_text)) return *real;
    return std::string(text);
}

}  // namespace talus::formats::toml
