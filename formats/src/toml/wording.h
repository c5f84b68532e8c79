#pragma once
// Wording of found and allowed values in messages.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace talus::formats::toml {

/// The shortest text that reads back as the same number.
std::string numberText(double value);

/// Control characters replaced, so that a message stays one line and a terminal stays as it is.
std::string oneLine(std::string text);

/// In double quotes, control characters replaced, shortened when long.
std::string quoted(std::string_view text);

/// `a, b, c`, shortened when long.
std::string listed(const std::vector<std::string>& names);

/// `a key`, or `joint."my key"` when the last part is no bare TOML key.
std::string joinField(std::string_view parent, std::string_view key);
std::string elementField(std::string_view parent, std::size_t index);

/// The most likely intended candidate, if one is near enough: by few edits (insert, delete, replace, swap of
/// neighbours; case ignored), or where one continues the other ("friction" for "friction_deg").
std::optional<std::string> nearest(std::string_view found, const std::vector<std::string>& candidates);

/// `, did you mean "columns"?` or `, allowed: ...`.
std::string suggestion(std::string_view found, const std::vector<std::string>& candidates);

}  // namespace talus::formats::toml
