#include "toml/field_path.h"

#include <array>
#include <charconv>

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
        const std::string_view ends = is_quoted ? rest_.substr(0, 1) : std::string_view(".[");
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

std::string_view lastKey(std::string_view field) {
    while (!field.empty() && field.back() == ']') field = field.substr(0, field.rfind('['));
    const auto dot = field.rfind('.');
    return dot == std::string_view::npos ? field : field.substr(dot + 1);
}

}  // namespace

std::optional<FieldPath> parseField(std::string_view field) { return FieldParser(field).parse(); }

std::optional<JointField> jointField(const FieldPath& path) {
    if (path.size() != 3 || path[0] != PathPart(std::string("joint"))) return std::nullopt;
    const auto* joint = std::get_if<std::string>(&path[1]);
    const auto* key = std::get_if<std::string>(&path[2]);
    if (!joint || !key) return std::nullopt;
    return JointField{*joint, *key};
}

std::string unitOf(std::string_view field) {
    struct Unit {
        std::string_view key, unit;
    };
    static constexpr std::array kUnits{
        Unit{"normal_stiffness", "Pa/m"},
        Unit{"shear_stiffness", "Pa/m"},
        Unit{"cohesion", "Pa"},
        Unit{"tensile_strength", "Pa"},
        Unit{"residual_cohesion", "Pa"},
        Unit{"density", "kg/m^3"},
        Unit{"depth", "m"},
        Unit{"elevation", "m"},
        Unit{"head", "m"},
        Unit{"base", "m"},
        Unit{"drains_at_aperture", "m"},
        Unit{"block", "m"},
        Unit{"origin", "m"},
        Unit{"magnitude", "m/s^2"},
        Unit{"velocity", "m/s"},
        Unit{"mass", "1/s"},
        Unit{"rotation", "1/s"},
    };
    const std::string_view key = lastKey(field);
    if (key.ends_with("_deg")) return "deg";
    if (key.ends_with("_s")) return "s";
    if (key.ends_with("_m")) return "m";
    for (const Unit& unit : kUnits)
        if (unit.key == key) return std::string(unit.unit);
    return "";
}

}  // namespace talus::formats::toml
