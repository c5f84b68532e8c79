#pragma once
// SHA-256 (FIPS 180-4): which input a result was made from, as `sha256sum` says it.

#include <string>
#include <string_view>

namespace talus::tools {

std::string sha256(std::string_view bytes);  ///< 64 hex digits

}  // namespace talus::tools
