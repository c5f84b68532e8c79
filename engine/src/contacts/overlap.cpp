#include "contacts/overlap.h"

#include <algorithm>

#include "contacts/neighbours.h"
#include "geometry/separation.h"
#include "state/placed_shape.h"

namespace talus {

double greatestOverlap(const State& state) {
    const std::vector<std::int32_t>& block_of = state.geometry->part_block;
    std::vector<Box> boxes;
    std::vector<Polyhedron> shapes;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        for (Polyhedron& part : partsOf(placedShape(state, b))) {
            Box box{part.vertices[0], part.vertices[0]};
            for (const Vec3& v : part.vertices) box = {box.min.cwiseMin(v), box.max.cwiseMax(v)};
            boxes.push_back(box);
            shapes.push_back(std::move(part));
        }
    double greatest = 0;
    for (const auto& [a, b] : findNeighbours(boxes, false)) {
        const auto part_1 = static_cast<std::size_t>(a), part_2 = static_cast<std::size_t>(b);
        const auto i = static_cast<std::size_t>(block_of[part_1]),
                   j = static_cast<std::size_t>(block_of[part_2]);
        if (i == j) continue;
        if (state.blocks.motion[i] != Motion::free && state.blocks.motion[j] != Motion::free) continue;
        const double size = std::min(state.geometry->size[i], state.geometry->size[j]);
        greatest = std::max(greatest, -separation(shapes[part_1], shapes[part_2]) / size);
    }
    return greatest;
}

}  // namespace talus
