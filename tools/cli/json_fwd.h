#pragma once
// The JSON type for declarations; code that builds or reads JSON includes cli/json.h, which takes a second to
// compile.

#include <nlohmann/json_fwd.hpp>

namespace talus::tools {

using Json = nlohmann::ordered_json;  ///< keys stay in the order they were put in

}  // namespace talus::tools
