#pragma once
// How thick a body is at a place.

#include "geometry/parts.h"

namespace talus {

/// How far a line from a point of a part's surface goes on inside the body, from part to part beside it
/// [m]; 0 where it does not. Works in the world, as PartOfBody does.
/// \param inwards  unit vector
/// \param enough   no farther is looked [m]
double thicknessAt(const PartOfBody& body, const Vec3& surface, const Vec3& inwards, double enough);

}  // namespace talus
