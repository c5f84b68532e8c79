#pragma once
// Hash of a result's input: XXH3 with 128 bits, as `xxh128sum` prints it.

#include <string>
#include <string_view>

namespace talus::tools {

std::string xxh128(std::string_view bytes);  ///< 32 hex digits

}  // namespace talus::tools
