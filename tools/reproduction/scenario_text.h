#pragma once
// Variants of a scenario as text, so that every computed case can be shown and run again from a file.

#include <string>
#include <string_view>

namespace talus::tools {

/// The scenario with `key = value` in its first table `header` ("[contact]", "[[stack]]"). An existing value
/// is replaced (its comment stays), a missing key is put first in its table, a missing table is appended.
/// `value` is TOML.
std::string withValue(std::string_view scenario, std::string_view header, std::string_view key,
                      std::string_view value);

}  // namespace talus::tools
