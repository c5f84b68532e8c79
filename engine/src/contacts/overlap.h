#pragma once
// How deep blocks are pressed into each other, by their shapes and whatever their contacts say.

#include "state/arrays.h"

namespace talus {

/// Greatest overlap of two blocks of which one can move, along the axis that parts them soonest, in shares of
/// the smaller one's least extent. Reads poses and shapes.
double greatestOverlap(const State& state);

}  // namespace talus
