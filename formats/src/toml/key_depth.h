#pragma once
// A guard before the TOML parser. The parser builds one nested table per part of a dotted key and destroys
// them recursively, so a key of a hundred thousand parts would overflow the stack.

#include <optional>
#include <string_view>

#include "toml/place.h"

namespace talus::formats::toml {

inline constexpr int kMaxKeyDepth = 16;  ///< a scenario needs three ("material.granite.density")

/// Place of the first dotted key of more than kMaxKeyDepth parts.
std::optional<Place> tooDeepKey(std::string_view text);

}  // namespace talus::formats::toml
