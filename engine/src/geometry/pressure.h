#pragma once
// Water pressure on a plane polygon, integrated exactly.

#include <algorithm>

#include "geometry/polygon.h"

namespace talus {

/// p(x, y) = max(0, at_origin + gradient . (x, y)) in the polygon's plane.
struct LinearPressure {
    double at_origin = 0;          ///< [Pa]
    Vec2 gradient = Vec2::Zero();  ///< [Pa/m]

    double at(const Vec2& point) const { return at_origin + gradient.dot(point); }  ///< without the max [Pa]
};

/// Thrust and moments of a pressure on a wall.
struct Thrust {
    double force = 0;     ///< integral of p dA [N]
    double moment_x = 0;  ///< integral of p x dA [N m]
    double moment_y = 0;  ///< integral of p y dA [N m]
};

/// Properties of a polygon for the thrust of a pressure that is nowhere negative.
struct PolygonMoments {
    double area = 0;               ///< [m^2]
    Vec2 centroid = Vec2::Zero();  ///< [m]
    SecondMoments second{};        ///< about the centroid [m^4]
};
PolygonMoments momentsOf(const Polygon& polygon);  ///< \pre area > 0

/// Thrust of a linear pressure that is nowhere negative: A p(c); moments: c times that, plus the second
/// moments times the gradient.
inline Thrust thrustOnWhole(const PolygonMoments& polygon, const LinearPressure& pressure) {
    const double force = polygon.area * pressure.at(polygon.centroid);
    const auto& [xx, xy, yy] = polygon.second;
    const Vec2& g = pressure.gradient;
    return {force, force * polygon.centroid.x() + xx * g.x() + xy * g.y(),
            force * polygon.centroid.y() + xy * g.x() + yy * g.y()};
}

struct PressureRange {
    double least = 0, most = 0;  ///< [Pa]
};
/// Over a polygon's corners, corner(k) the k-th. \pre corners > 0
template <class Corner>
PressureRange pressureOver(std::size_t corners, const Corner& corner, const LinearPressure& pressure) {
    const double first = pressure.at(corner(0));
    PressureRange range{first, first};
    for (std::size_t k = 1; k < corners; ++k) {
        const double p = pressure.at(corner(k));
        range.least = std::min(range.least, p);
        range.most = std::max(range.most, p);
    }
    return range;
}

/// Of max(0, p) over a convex polygon with `corners` corners, corner(k) the k-th, counter-clockwise. The part
/// above the water line is left out on the way round.
///
/// Over a triangle of area A, with p and x linear: integral of p = A/3 sum(p), and integral of p x = A/12
/// (sum(p) sum(x) + sum(p x)), sums over the corners. Corners are taken relative to the first wet one, so
/// that the moments of a polygon far from its origin do not cancel inside the sum.
template <class Corner>
Thrust thrustOn(std::size_t corners, const Corner& corner, const LinearPressure& pressure) {
    Thrust thrust;
    Vec2 apex = Vec2::Zero(), last = Vec2::Zero(), moment = Vec2::Zero();
    double p_apex = 0, p_last = 0;
    int wet = 0;
    const auto add = [&](const Vec2& point, double p) {
        if (++wet == 1) {
            apex = point;
            p_apex = p;
        } else {
            const Vec2 b = last, c = point - apex;
            const double triangle = 0.5 * (b.x() * c.y() - b.y() * c.x()), sum = p_apex + p_last + p;
            thrust.force += triangle / 3.0 * sum;
            moment += triangle / 12.0 * (sum * (b + c) + p_last * b + p * c);
        }
        last = point - apex;
        p_last = p;
    };
    if (corners == 0) return thrust;
    Vec2 from = corner(corners - 1);
    double p_from = pressure.at(from);
    for (std::size_t k = 0; k < corners; ++k) {
        const Vec2 to = corner(k);
        const double p_to = pressure.at(to);
        if ((p_from > 0 && p_to < 0) || (p_from < 0 && p_to > 0))
            add(from + p_from / (p_from - p_to) * (to - from), 0.0);
        if (p_to >= 0) add(to, p_to);
        from = to;
        p_from = p_to;
    }
    moment += thrust.force * apex;
    thrust.moment_x = moment.x();
    thrust.moment_y = moment.y();
    return thrust;
}
Thrust thrustOn(const Polygon& polygon, const LinearPressure& pressure);

/// Where p > 0; the polygon itself, unclipped, when that is all of it.
Polygon wetPart(const Polygon& polygon, const LinearPressure& pressure);

}  // namespace talus
