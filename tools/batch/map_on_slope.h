#pragma once
// A map of failure on the blocks of the scenario file, as a page for the browser: the replay page with cells.

#include <string>

#include "batch/failure_map.h"
#include "cli/common.h"
#include "talus/formats/snapshot.h"

namespace talus::tools::batch {

/// The blocks that the map is drawn on.
struct Slope {
    formats::SnapshotHeader header;
    LightFrame frame;
};

/// Throws BadInput where the scenario of the file has no such blocks.
Slope slopeOf(const formats::Sweep& sweep);

std::string mapOnSlope(const FailureMap& map, const BatchInfo& info, const Slope& slope,
                       const Common& common);

}  // namespace talus::tools::batch
