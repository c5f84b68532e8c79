#include "geometry/pressure.h"

namespace talus {

PolygonMoments momentsOf(const Polygon& polygon) {
    PolygonMoments moments{area(polygon), centroid(polygon), {}};
    Polygon about_centroid;
    for (const Vec2& p : polygon) about_centroid.push(p - moments.centroid);
    moments.second = secondMoments(about_centroid);
    return moments;
}

Thrust thrustOn(const Polygon& polygon, const LinearPressure& pressure) {
    return thrustOn(
        polygon.size(), [&](std::size_t k) { return polygon[k]; }, pressure);
}

Polygon wetPart(const Polygon& polygon, const LinearPressure& pressure) {
    if (polygon.empty()) return {};
    const PressureRange range = pressureOver(
        polygon.size(), [&](std::size_t k) { return polygon[k]; }, pressure);
    if (range.most <= 0) return {};
    if (range.least >= 0) return polygon;
    return clipHalfPlane(polygon, -pressure.gradient, pressure.at_origin);
}

}  // namespace talus
