#include "toml/field_path.h"

#include <algorithm>
#include <charconv>
#include <string>

namespace talus::formats::toml {

namespace {

/// Reads a field from left to right; `failed` once something does not fit.
class FieldParser {
 public:
    explicit FieldParser(std::string_view text) : rest_(text) {}

    std::optional<FieldPath> parse() {
        key();
        while (!failed_ && !rest_.empty()) {
            const char c = take();
            if (c == '.')
                key();
            else if (c == '[')
                index();
            else
                failed_ = true;
        }
        return failed_ ? std::nullopt : std::optional(path_);
    }

 private:
    char take() {
        const char c = rest_.front();
        rest_.remove_prefix(1);
        return c;
    }

    void key() {
        const bool is_quoted = !rest_.empty() && (rest_.front() == '"' || rest_.front() == '\'');
        const std::string_view ends = is_quoted ? rest_.substr(0, 1) : std::string_view(".[]");
        if (is_quoted) take();
        const auto length = std::min(rest_.find_first_of(ends), rest_.size());
        path_.emplace_back(std::string(rest_.substr(0, length)));
        failed_ |= length == 0 || (is_quoted && length == rest_.size());
        rest_.remove_prefix(length);
        if (is_quoted && !failed_) take();
    }

    void index() {
        std::size_t value = 0;
        const auto read = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        rest_.remove_prefix(static_cast<std::size_t>(read.ptr - rest_.data()));
        failed_ |= read.ec != std::errc() || rest_.empty() || take() != ']';
        path_.emplace_back(value);
    }

    std::string_view rest_;
    FieldPath path_;
    bool failed_ = false;
};

}  // namespace

std::string_view lastKey(std::string_view field) {
    while (field.ends_with(']')) {
        const auto bracket = field.rfind('[');
        if (bracket == std::string_view::npos) break;
        field = field.substr(0, bracket);
    }
    const auto dot = field.rfind('.');
    return dot == std::string_view::npos ? field : field.substr(dot + 1);
}

std::optional<FieldPath> parseField(std::string_view field) { return FieldParser(field).parse(); }

}  // namespace talus::formats::toml
