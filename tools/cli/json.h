#pragma once
// Results as JSON.

#include <nlohmann/json.hpp>
#include <vector>

#include "cli/json_fwd.h"
#include "talus/result.h"

namespace talus::tools {

void printJson(const Json& json);  ///< one object and a newline on stdout; throws FileRefused
Json number(double value);         ///< null when not finite
Json errorsJson(
    const std::vector<Error>& errors);  ///< {"ok": false, "errors": [{file, line, column, field, message}]}

/// [x, y, z]
template <class Vector>
Json vector(const Vector& value) {
    return Json::array({number(value.x()), number(value.y()), number(value.z())});
}

}  // namespace talus::tools
