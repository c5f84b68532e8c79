#pragma once
// Shapes of blocks where they are now.

#include "state/arrays.h"

namespace talus {

/// A block's shape in the model frame, where it is now.
Polyhedron placedShape(const State& state, std::size_t block);

/// The same into a shape there is already: blocks one after the other need no new memory.
void placeShape(const State& state, std::size_t block, Polyhedron& shape);

}  // namespace talus
