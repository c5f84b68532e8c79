#pragma once
// Common area of circles and polygons.

#include <algorithm>
#include <cmath>

#include "geometry/polygon.h"

namespace talus::rock_mass {

inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Area of the unit circle's sector from p to q, signed.
inline double sector(const Vec2& p, const Vec2& q) { return 0.5 * std::atan2(cross(p, q), p.dot(q)); }

/// Of the unit circle about the origin and the triangle (origin, p, q), signed. Summed over the edges of a
/// closed line it is the common area of the circle and the inside.
inline double commonArea(const Vec2& p, const Vec2& q) {
    const Vec2 d = q - p;
    const double a = d.squaredNorm(), b = p.dot(d), c = p.squaredNorm() - 1, root = b * b - a * c;
    if (a == 0) return 0;
    if (root <= 0) return sector(p, q);
    const double in = (-b - std::sqrt(root)) / a, out = (-b + std::sqrt(root)) / a;
    if (in >= 1 || out <= 0) return sector(p, q);
    const Vec2 from = p + std::max(in, 0.0) * d, to = p + std::min(out, 1.0) * d;
    return (in > 0 ? sector(p, from) : 0) + 0.5 * cross(from, to) + (out < 1 ? sector(to, q) : 0);
}

/// Of a circle about the origin and a polygon [m^2].
inline double areaInCircle(const Polygon& polygon, double radius) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sum += commonArea(polygon[i] / radius, polygon.next(i) / radius);
    return std::clamp(sum * radius * radius, 0.0, area(polygon));
}

}  // namespace talus::rock_mass
