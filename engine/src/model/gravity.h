#pragma once
// Directions of gravity and of an earthquake. The compass tilts with the assembly: a direction that is level
// in the model is level on the tilted table.

#include "talus/model.h"

namespace talus {

/// The unit vector along gravity, at a tilt about y. With gravity's default direction (-sin, 0, -cos) of the
/// tilt.
Vec3 downward(const Gravity& gravity, double tilt);

/// East, north and up under gravity, as columns: x, y and z by the shortest turn that takes -z to gravity's
/// direction, then tilted.
Mat3 compass(const Gravity& gravity, double tilt);

/// The level unit vector along which a pseudo-static earthquake pushes.
Vec3 pushOf(const Seismic& seismic, const Gravity& gravity, double tilt);

/// The acceleration of a pseudo-static earthquake with this horizontal coefficient, over that of gravity.
Vec3 seismicShare(const Seismic& seismic, double horizontal, const Gravity& gravity, double tilt);

}  // namespace talus
