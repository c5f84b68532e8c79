#pragma once
// The name of JSON for declarations; who builds or reads it includes cli/json.h, which takes a second to
// compile.

#include <nlohmann/json_fwd.hpp>

namespace talus::tools {

using Json = nlohmann::ordered_json;  ///< keys stay in the order they were put in

}  // namespace talus::tools
