#include "geometry/pressure.h"

#include <algorithm>

namespace talus {
namespace {

/// The polygon where the pressure is positive; unclipped when all of it is.
Polygon wetPart(const Polygon& polygon, const LinearPressure& pressure) {
    double least = pressure.at(polygon[0]), most = least;
    for (const Vec2& p : polygon) {
        least = std::min(least, pressure.at(p));
        most = std::max(most, pressure.at(p));
    }
    if (most <= 0) return {};
    if (least >= 0) return polygon;
    return clipHalfPlane(polygon, -pressure.gradient, pressure.at_origin);
}

}  // namespace

// Over a triangle of area A, with p and x linear: integral of p = A/3 sum(p), and integral of p x = A/12
// (sum(p) sum(x) + sum(p x)), sums over the corners. Corners are taken relative to the first one, so that the
// moments of a polygon far from its origin do not cancel inside the sum.
PressureIntegral integratePressure(const Polygon& polygon, const LinearPressure& pressure) {
    PressureIntegral sum;
    if (polygon.empty()) return sum;
    sum.wet = wetPart(polygon, pressure);
    if (sum.wet.empty()) return sum;
    const Vec2 apex = sum.wet[0];
    // Corners on the water line carry the rounding of the clip.
    const auto wet_pressure = [&](const Vec2& point) { return std::max(0.0, pressure.at(point)); };
    const double p_a = wet_pressure(apex);
    Vec2 moment = Vec2::Zero();
    for (std::size_t i = 2; i < sum.wet.size(); ++i) {
        const Vec2 b = sum.wet[i - 1] - apex, c = sum.wet[i] - apex;
        const double p_b = wet_pressure(sum.wet[i - 1]), p_c = wet_pressure(sum.wet[i]);
        const double triangle = 0.5 * (b.x() * c.y() - b.y() * c.x()), p = p_a + p_b + p_c;
        sum.force += triangle / 3.0 * p;
        moment += triangle / 12.0 * (p * (b + c) + p_b * b + p_c * c);
    }
    moment += sum.force * apex;
    sum.moment_x = moment.x();
    sum.moment_y = moment.y();
    return sum;
}

}  // namespace talus
