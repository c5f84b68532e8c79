#pragma once
// Shapes of blocks where they are now.

#include "state/arrays.h"

namespace talus {

/// A block's shape in the model frame, where it is now.
Polyhedron placedShape(const State& state, std::size_t block);

/// The same into a shape there is already: blocks one after the other need no new memory.
void placeShape(const State& state, std::size_t block, Polyhedron& shape);

/// A point of the model frame in a block's own.
Vec3 toOwn(const Blocks& blocks, std::int32_t block, const Vec3& x);

}  // namespace talus
