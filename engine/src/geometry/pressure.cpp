#include "geometry/pressure.h"

#include <algorithm>

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
        polygon.size(), [&](std::size_t k) -> const Vec2& { return polygon[k]; }, pressure);
}

Polygon wetPart(const Polygon& polygon, const LinearPressure& pressure) {
    if (polygon.empty()) return {};
    double least = pressure.at(polygon[0]), most = least;
    for (const Vec2& p : polygon) {
        least = std::min(least, pressure.at(p));
        most = std::max(most, pressure.at(p));
    }
    if (most <= 0) return {};
    if (least >= 0) return polygon;
    return clipHalfPlane(polygon, -pressure.gradient, pressure.at_origin);
}

}  // namespace talus
