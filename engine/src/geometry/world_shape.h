#pragma once
// A block where it stands, without a copy of what does not change.

#include <cstdint>
#include <span>
#include <vector>

#include "talus/polyhedron.h"

namespace talus {

/// A block as it stands in the world; refers to the caller's arrays.
struct WorldShape {
    std::span<const Vec3> vertices;                    ///< [m]
    std::span<const std::vector<std::int32_t>> faces;  ///< as in Polyhedron
    std::span<const Vec3> normals;                     ///< outward unit normal per face
};

}  // namespace talus
