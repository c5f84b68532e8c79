#pragma once
// The region of a scenario's rock mass, before joints cut it.

#include <optional>
#include <string>

#include "talus/result.h"
#include "talus/surface.h"

namespace talus::formats {

/// Of a scenario's text; nothing without a rock mass. `path` is used in messages, and its folder is where
/// mesh files are looked for.
Result<std::optional<TriangleSurface>> rockRegion(const std::string& text, const std::string& path);

}  // namespace talus::formats
