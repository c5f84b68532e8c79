#pragma once
// Water pressure on a plane polygon, integrated exactly.

#include "geometry/polygon.h"

namespace talus {

/// p(x, y) = max(0, at_origin + gradient . (x, y)) in the polygon's plane.
struct LinearPressure {
    double at_origin = 0;          ///< [Pa]
    Vec2 gradient = Vec2::Zero();  ///< [Pa/m]

    double at(const Vec2& point) const { return at_origin + gradient.dot(point); }  ///< without the max [Pa]
};

struct PressureIntegral {
    double force = 0;     ///< integral of p dA [N]
    double moment_x = 0;  ///< integral of p x dA [N m]
    double moment_y = 0;  ///< integral of p y dA [N m]
    Polygon wet{};        ///< where p > 0
};

/// Clips the polygon at the water line and integrates in closed form.
PressureIntegral integratePressure(const Polygon& polygon, const LinearPressure& pressure);

}  // namespace talus
