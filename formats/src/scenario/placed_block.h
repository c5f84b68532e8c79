#pragma once
// [[block]]: one block placed by hand, or all solids of a mesh file.

#include "scenario/properties.h"
#include "scenario/reading.h"
#include "talus/model.h"

namespace talus::formats::scenario {

/// A block of a [[block]] table; it is complete when the table has no errors.
struct PlacedBlock {
    Block block;
    Place place;
    Place name_place;
    bool name_known = false;
};

/// One block, or with `each_solid = true` one for each solid of its mesh. Its name is the key `name`, which
/// may be empty, and the solid's own name or number. \param folder of the scenario, where mesh files are
/// looked for
std::vector<PlacedBlock> readPlacedBlocks(Report& report, const FieldNode& entry, const Materials& materials,
                                          const Joints& joints, const std::string& folder);

}  // namespace talus::formats::scenario
