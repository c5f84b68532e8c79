#pragma once
// Where the table of a water lies, by its depth or elevation.

#include "state/arrays.h"

namespace talus {

/// A point of a wall, given in the wall's plane, as the wall lay at the start [m].
Vec3 initialPoint(const State& state, std::size_t wall, const Vec2& point);

/// A point of the water table whose level is a depth up the joint plane's steepest line from its lowest wet
/// point, as the joint lay at the start.
Vec3 tablePoint(const State& state, std::size_t water, double depth, const Vec3& down);

/// How high the table of a water stands along gravity, above the state's origin, by its level [m].
struct TableHeight {
    double at_zero = 0, per_level = 1;

    double at(double level) const { return at_zero + per_level * level; }
    double levelOf(double height) const { return (height - at_zero) / per_level; }
};
/// \pre it is given by a depth or an elevation
TableHeight tableHeight(const State& state, std::size_t water, double tilt);

}  // namespace talus
