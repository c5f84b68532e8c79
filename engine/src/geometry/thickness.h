#pragma once
// How thick a body is at a place.

#include "geometry/parts.h"

namespace talus {

/// Length inside the body of a line from a point of a part's surface, through adjoining parts [m]; 0 where it
/// leaves at once. Works in the world, as PartOfBody does.
/// \param inwards  unit vector
/// \param enough   no farther is looked [m]
double thicknessAt(const PartOfBody& body, const Vec3& surface, const Vec3& inwards, double enough);

}  // namespace talus
