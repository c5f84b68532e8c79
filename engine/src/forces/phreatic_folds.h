#pragma once
// Water tables that fold back when they are seen along gravity: they are refused.

#include <optional>
#include <string>

#include "talus/model.h"
#include "talus/result.h"

namespace talus::phreatic {

/// Across gravity and y: along it the points of a line have to follow each other.
Vec3 acrossOf(const Vec3& down);

/// For messages: "(1, 2, 3)".
std::string placeText(const Vec3& point);

/// A line whose points are not in order across gravity, or a mesh with a triangle that faces down.
std::optional<Error> foldedSurface(const PhreaticSurface& surface, const Vec3& down);

}  // namespace talus::phreatic
