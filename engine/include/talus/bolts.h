#pragma once
// Patterns of bolts on faces.

#include <optional>
#include <vector>

#include "talus/model.h"
#include "talus/result.h"

namespace talus {

/// Makes the bolts of the model's patterns, behind the others and in place of any made before: heads on the
/// free faces inside each box that look its way within 60 degrees, one for each `spacing` along and up the
/// plane these faces lie in on average, from the middle outwards. Errors: a box without such a face.
std::vector<Error> placeBoltPatterns(Model& model);

/// How far the free faces of a pattern reach along and up the plane that they lie in on average.
struct PatternExtent {
    double along = 0, up = 0;  ///< [m]
};
/// Nothing where no free face in its box looks its way.
std::optional<PatternExtent> extentOf(const BoltPattern& pattern, const Model& model);

}  // namespace talus
