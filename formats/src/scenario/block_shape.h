#pragma once
// The shape of a [[block]]: a box, the hull of some points, convex parts, or a mesh file, which may have
// several.

#include <optional>
#include <string>
#include <vector>

#include "scenario/reading.h"
#include "talus/polyhedron.h"

namespace talus::formats::scenario {

/// Nothing when the table has none that is sound, which is reported. \param folder of the scenario, where
/// mesh files are looked for
std::optional<Polyhedron> readShape(Report& report, TableReader& table, const std::string& folder);

struct NamedShape {
    std::string name;  ///< of its own, or its number from 1
    Polyhedron shape;
};

/// Of a table with `each_solid = true`: those of its mesh file, which is reported where it is not sound.
std::vector<NamedShape> readSolidShapes(Report& report, TableReader& table, const std::string& folder);

/// Keys of a table that say its shape.
const std::vector<std::string>& shapeKeys();

}  // namespace talus::formats::scenario
