#pragma once
// Fields of a scenario as a user writes them: `water[0].depth`, `joint."my joint".friction_deg`.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "toml/document.h"

namespace talus::formats::toml {

using FieldPath = std::vector<PathPart>;

/// The parts of a field, or nothing when it is not written like one.
std::optional<FieldPath> parseField(std::string_view field);

/// `joint.NAME.KEY` taken apart.
struct JointField {
    std::string joint;  ///< "*": all
    std::string key;
};
std::optional<JointField> jointField(const FieldPath& path);

/// The unit a field's value has, by its name: "deg", "s", "Pa", ...; "" when it has none.
std::string unitOf(std::string_view field);

}  // namespace talus::formats::toml
