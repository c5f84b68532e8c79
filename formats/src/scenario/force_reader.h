#pragma once
// What the sections of forces are read with.

#include <string>

#include "scenario/directory.h"
#include "scenario/properties.h"
#include "scenario/reading.h"

namespace talus::formats::scenario {

struct ForceReader {
    Report& report;
    TableReader& root;
    const BlockDirectory& blocks;
    const Joints& joints;
    const std::string& folder;  ///< where files are looked for: "" or with a slash at its end
};

}  // namespace talus::formats::scenario
