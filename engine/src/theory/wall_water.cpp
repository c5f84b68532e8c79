#include "theory/wall_water.h"

#include <algorithm>
#include <cmath>

#include "model/over_time.h"

namespace talus::theory {

namespace {

struct Span {
    double low = kInfinity, high = -kInfinity;
};

Span heightsOf(const Model& model, const WetFace& wall) {
    const Polyhedron& shape = model.blocks[wall.block].shape;
    Span span;
    for (const std::int32_t vertex : shape.faces[wall.face]) {
        span.low = std::min(span.low, shape.vertices[vertex].z());
        span.high = std::max(span.high, shape.vertices[vertex].z());
    }
    return span;
}

bool isUprightRectangleAcrossX(const Model& model, const WetFace& wall) {
    const Polyhedron& shape = model.blocks[wall.block].shape;
    const auto& corners = shape.faces[wall.face];
    if (corners.size() != 4 || std::abs(shape.faceNormal(wall.face).x()) < 1 - 1e-12) return false;
    const Vec3 edge = shape.vertices[corners[1]] - shape.vertices[corners[0]];
    const Vec3 next = shape.vertices[corners[2]] - shape.vertices[corners[1]];
    const double size = edge.norm() + next.norm();
    const auto small = [size](double value) { return std::abs(value) < 1e-12 * size; };
    return (small(edge.y()) && small(next.z())) || (small(edge.z()) && small(next.y()));
}

/// A level over time counts by its value at the start, as in the analyses; a draining joint has not opened
/// before the first failure.
bool hasDepth(const Water& water) {
    return water.kind == Water::Level::depth && !water.pair && !water.level.empty() && water.outline.empty();
}

double lowestWetPoint(const Model& model, const Water& water) {
    double lowest = kInfinity;
    for (const WetFace& wall : water.walls) lowest = std::min(lowest, heightsOf(model, wall).low);
    return std::max(lowest, water.base);
}

}  // namespace

double WallWater::thrust() const {
    const double deep = top - low, shallow = top - high;
    return 0.5 * unit_weight * (deep * deep - shallow * shallow);
}

double WallWater::momentAbout(double z) const {
    const double deep = top - low, shallow = top - high;
    const double cubes = (deep * deep * deep - shallow * shallow * shallow) / 3;
    return (top - z) * thrust() - unit_weight * cubes;
}

std::optional<std::vector<WallWater>> wallWaters(const Model& model, const std::vector<Water>& waters) {
    std::vector<WallWater> result;
    for (const Water& water : waters) {
        if (!hasDepth(water)) return std::nullopt;
        const double low = lowestWetPoint(model, water), top = low + levelAt(water, 0.0);
        for (const WetFace& wall : water.walls) {
            const Block& block = model.blocks[wall.block];
            if (block.motion != Motion::free) continue;
            if (!isUprightRectangleAcrossX(model, wall)) return std::nullopt;
            const Span span = heightsOf(model, wall);
            const double width = block.shape.faceArea(wall.face) / (span.high - span.low);
            const WallWater wet{wall.block,
                                block.shape.faceNormal(wall.face).x() > 0,
                                water.density * model.gravity.magnitude * width,
                                std::max(span.low, low),
                                std::min(span.high, top),
                                top};
            if (wet.high > wet.low) result.push_back(wet);
        }
    }
    return result;
}

}  // namespace talus::theory
