#pragma once
// Warnings of what block theory leaves out of a model.

#include <string>
#include <vector>

#include "block_theory/groups.h"
#include "block_theory/slope.h"
#include "state/arrays.h"

namespace talus::keyblocks {

std::vector<std::string> warningsOf(const State& state, const Slope& slope, const GroupSearch& search);

}  // namespace talus::keyblocks
