#pragma once
// The sections that say what pushes on blocks beside their weight and water: one list, each with its reader.

#include <span>

#include "scenario/directory.h"
#include "scenario/reading.h"
#include "talus/model.h"

namespace talus::formats::scenario {

struct ForceSection {
    const char* name;
    /// Adds to the model what the section's tables say. The names of all blocks are known.
    void (*read)(Report& report, TableReader& root, const BlockDirectory& blocks, Model& model);
};

std::span<const ForceSection> forceSections();

}  // namespace talus::formats::scenario
