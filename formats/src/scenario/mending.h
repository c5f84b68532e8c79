#pragma once
// `repair` and `largest_hole` of a mesh.

#include "scenario/reading.h"
#include "talus/formats/mesh.h"

namespace talus::formats::scenario {

void readMending(TableReader& table, MeshOptions& options);

}  // namespace talus::formats::scenario
