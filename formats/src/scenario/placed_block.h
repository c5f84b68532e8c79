#pragma once
// [[block]]: one block placed by hand.

#include "scenario/properties.h"
#include "scenario/reading.h"
#include "talus/model.h"

namespace talus::formats::scenario {

/// What a [[block]] table says; the block is complete when the table has no errors.
struct PlacedBlock {
    Block block;
    Place place;
    Place name_place;
    bool name_known = false;
};

/// \param folder of the scenario, where mesh files are looked for
PlacedBlock readPlacedBlock(Report& report, const FieldNode& entry, const Materials& materials,
                            const Joints& joints, const std::string& folder);

}  // namespace talus::formats::scenario
