#include "contacts/limits.h"

#include <algorithm>

namespace talus {
namespace {

constexpr double kTie = 1e-4;         // of the smaller block's size: see VertexEdgeLimits
constexpr double kLeastReach = 1e-3;  // of the smaller block's size
}  // namespace

VertexEdgeLimits vertexEdgeLimits(const Geometry& geometry, std::size_t block_1, std::size_t block_2,
                                  double reach) {
    const double size = std::min(geometry.size[block_1], geometry.size[block_2]);
    return {.face_angle = kFaceAngle,
            .angle_per_depth = kFaceAnglePerDepth / size,
            .tie = kTie * size,
            .reach = std::max(kLeastReach * size, reach)};
}

double vertexEdgeArea(const Geometry& geometry, std::size_t block_1, std::size_t block_2) {
    const double area = std::min(geometry.face_area[block_1], geometry.face_area[block_2]);
    const PointRule& rule = geometry.model.points;
    switch (rule.kind) {
        case PointRule::Kind::vertex:
        case PointRule::Kind::distributed:
            break;
        case PointRule::Kind::corner:
        case PointRule::Kind::quarter:
            return area / 4;
        case PointRule::Kind::grid:
            return area / (rule.grid * rule.grid);
    }
    return area / 24;
}

}  // namespace talus
