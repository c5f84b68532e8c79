#pragma once
// Fields of a file as a user writes them: `water[0].depth`, `joint."my joint".friction_deg`.

#include <optional>
#include <string_view>
#include <vector>

#include "toml/document.h"

namespace talus::formats::toml {

using FieldPath = std::vector<PathPart>;

/// The parts of a field, or nothing when it is not written like one.
std::optional<FieldPath> parseField(std::string_view field);

/// Its last key, without indices: `depth` of `water[0].depth`.
std::string_view lastKey(std::string_view field);

}  // namespace talus::formats::toml
