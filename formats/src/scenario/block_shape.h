#pragma once
// The shape of a [[block]]: a box, the hull of some points, convex parts, or a mesh file.

#include <optional>
#include <string>

#include "scenario/reading.h"
#include "talus/polyhedron.h"

namespace talus::formats::scenario {

/// Nothing when the table has none that is sound, which is reported. \param folder of the scenario, where
/// mesh files are looked for
std::optional<Polyhedron> readShape(Report& report, TableReader& table, const std::string& folder);

}  // namespace talus::formats::scenario
