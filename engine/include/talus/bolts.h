#pragma once
// Patterns of bolts on faces.

#include <optional>
#include <vector>

#include "talus/model.h"
#include "talus/result.h"

namespace talus {

/// Makes the bolts of the model's patterns. They follow the single bolts and replace any made before. Heads
/// lie on the free faces inside each box whose normals are within 60 degrees of its direction. They form a
/// grid of the `spacing` on the mean plane of these faces, from the middle outwards. Errors: a box without
/// such a face.
std::vector<Error> placeBoltPatterns(Model& model);

/// How far the free faces of a pattern reach along and up the plane that they lie in on average.
struct PatternExtent {
    double along = 0, up = 0;  ///< [m]
};
/// Nothing where the box has no free face within 60 degrees of its direction.
std::optional<PatternExtent> extentOf(const BoltPattern& pattern, const Model& model);

}  // namespace talus
