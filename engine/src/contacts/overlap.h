#pragma once
// Depth of overlap of blocks by their shapes, independent of their contacts.

#include "state/arrays.h"

namespace talus {

/// Greatest overlap of two blocks of which one can move, along the axis of least overlap, as a share of the
/// smaller one's least extent. Reads poses and shapes.
double greatestOverlap(const State& state);

}  // namespace talus
