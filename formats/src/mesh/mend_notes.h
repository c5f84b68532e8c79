#pragma once
// What was mended of a surface, in words.

#include <string>
#include <vector>

#include "talus/mend_surface.h"

namespace talus::formats::mesh {

/// "was mended: 2 doubled triangles left out, at (1, 2, 3) and (4, 5, 6)"; and of holes that stayed open.
std::vector<std::string> mendNotes(const MendedSurface& mended, double largest_hole);

/// "(1, 2, 3)"
std::string placeText(const Vec3& place);
/// Of so many digits at most.
std::string shortText(double value, int digits = 6);

}  // namespace talus::formats::mesh
