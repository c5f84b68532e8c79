#include "contacts/overlap.h"

#include <algorithm>

#include "contacts/neighbours.h"
#include "geometry/separation.h"
#include "state/placed_shape.h"

namespace talus {

double greatestOverlap(const State& state) {
    std::vector<Box> boxes;
    std::vector<Polyhedron> shapes;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        shapes.push_back(placedShape(state, b));
        Box box{shapes[b].vertices[0], shapes[b].vertices[0]};
        for (const Vec3& v : shapes[b].vertices) box = {box.min.cwiseMin(v), box.max.cwiseMax(v)};
        boxes.push_back(box);
    }
    double greatest = 0;
    for (const auto& [a, b] : findNeighbours(boxes, false)) {
        const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
        if (state.blocks.motion[i] != Motion::free && state.blocks.motion[j] != Motion::free) continue;
        const double size = std::min(state.geometry->size[i], state.geometry->size[j]);
        greatest = std::max(greatest, -separation(shapes[i], shapes[j]) / size);
    }
    return greatest;
}

}  // namespace talus
