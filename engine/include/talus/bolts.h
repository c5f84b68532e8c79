#pragma once
// Patterns of bolts on faces.

#include <vector>

#include "talus/model.h"
#include "talus/result.h"

namespace talus {

/// Makes the bolts of the model's patterns, behind the others and in place of any made before: heads on the free faces inside each box that look its way within 60 degrees, one for
/// each `spacing` along and up the plane these faces lie in on average, from the middle outwards. Errors: a box without such a
/// face.
std::vector<Error> placeBoltPatterns(Model& model);

}  // namespace talus
