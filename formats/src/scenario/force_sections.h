#pragma once
// The sections of forces on blocks beside weight and water: one list, each with its reader.

#include <span>
#include <vector>

#include "scenario/force_reader.h"
#include "talus/model.h"

namespace talus::formats::scenario {

struct ForceSection {
    const char* name;
    /// Adds to the model what the section's tables say. The names of all blocks are known.
    void (*read)(const ForceReader& from, Model& model);
    /// Once the model has its blocks; nullptr where nothing is left to do.
    std::vector<Error> (*place)(Model& model);
};

std::span<const ForceSection> forceSections();

}  // namespace talus::formats::scenario
