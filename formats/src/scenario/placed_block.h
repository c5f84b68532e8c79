#pragma once
// [[block]]: one block placed by hand, a box or a convex hull.

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

PlacedBlock readPlacedBlock(Report& report, const FieldNode& entry, const Materials& materials,
                            const Joints& joints);

}  // namespace talus::formats::scenario
