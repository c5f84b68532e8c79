#pragma once
// Simple polygons of many corners: outlines of slope profiles and of terrains in plan.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace talus::rock_mass {

using PlanePoint = Eigen::Vector2d;

/// Twice its area [m^2]; positive when counter-clockwise.
double doubleArea(const std::vector<PlanePoint>& polygon);

/// A corner at which a polygon turns back on itself, or two sides (the one behind corner `first`) that cross
/// or touch.
struct PolygonFault {
    std::size_t first = 0, second = 0;
    bool turns_back = false;
};
/// \pre three corners or more, no two in a row at one place
std::optional<PolygonFault> polygonFault(const std::vector<PlanePoint>& polygon);

/// Cuts off ears of a counter-clockwise simple polygon; corners on straight sides are used up last. Nothing
/// if it is too narrow.
std::vector<std::array<std::int32_t, 3>> triangulate(const std::vector<PlanePoint>& polygon);

}  // namespace talus::rock_mass
