#pragma once
// Results as JSON.

#include <nlohmann/json.hpp>
#include <vector>

#include "cli/json_fwd.h"
#include "talus/result.h"

namespace talus::tools {

/// As text. Use it in place of Json::dump, which throws for bytes that are not UTF-8. Names of files may hold
/// such bytes; U+FFFD replaces them.
std::string jsonText(const Json& json, int indent = -1);
void printJson(const Json& json);  ///< one object and a newline on stdout; throws FileRefused
Json number(double value);         ///< null when not finite
Json errorsJson(
    const std::vector<Error>& errors);  ///< {"ok": false, "errors": [{file, line, column, field, message}]}

/// A text with U+FFFD in place of bytes that are not UTF-8.
std::string validUtf8(const std::string& text);

/// [x, y, z]
template <class Vector>
Json vector(const Vector& value) {
    return Json::array({number(value.x()), number(value.y()), number(value.z())});
}

}  // namespace talus::tools
