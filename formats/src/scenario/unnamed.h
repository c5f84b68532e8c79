#pragma once
// Materials and joints that a file defines but never uses: a name misspelt in one of two places.

#include <optional>
#include <string>
#include <vector>

#include "scenario/reading.h"
#include "toml/field_path.h"

namespace talus::formats::scenario {

/// Names that other tables of a file refer to.
struct KnownNames {
    std::vector<std::string> joints, materials;
};

/// Error for a field of a joint or material not among those: it would be added without any use. Nothing for
/// other fields, where there are none to compare with, and for "*".
std::optional<std::string> unknownName(const FieldPath& path, const KnownNames& known);

/// Warns of each [material.NAME] and [joint.NAME] whose name occurs nowhere else in the file. Its intended
/// blocks and joints have another's strength or density. [joint.default] needs no name, nor does the only
/// material.
/// \param root  of the file
void warnOfUnnamed(Report& report, const Node& root);

}  // namespace talus::formats::scenario
