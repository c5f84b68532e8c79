#include "state/placed_shape.h"

namespace talus {

void placeShape(const State& state, std::size_t block, Polyhedron& shape) {
    shape = state.geometry->shape[block];
    const Mat3 turn = state.blocks.orientation.matrix(block);
    const Vec3 position = state.blocks.position.get(block);
    for (Vec3& v : shape.vertices) v = position + turn * v;
}

Polyhedron placedShape(const State& state, std::size_t block) {
    Polyhedron shape;
    placeShape(state, block, shape);
    return shape;
}

Vec3 toOwn(const Blocks& blocks, std::int32_t block, const Vec3& x) {
    const auto b = static_cast<std::size_t>(block);
    return blocks.orientation.matrix(b).transpose() * (x - blocks.position.get(b));
}

}  // namespace talus
