#pragma once
// Bolts as results, and patterns of them on faces.

#include <string>
#include <vector>

#include "talus/model.h"
#include "talus/result.h"

namespace talus {

/// One bolt as it stands, by its segment that carries most.
struct BoltReport {
    std::string name;
    double force = 0;        ///< [N]
    double utilisation = 0;  ///< force over what it can carry there, 0..1
    bool yielded = false;    ///< the bar has, somewhere
    bool slipped = false;    ///< it has slid through its grout, somewhere
    bool broken = false;     ///< somewhere
};

/// Turns the model's patterns into bolts: heads on the free faces inside each box that look its way within 60 degrees, one for
/// each `spacing` along and up the plane these faces lie in on average, from the middle outwards. Errors: a box without such a
/// face.
std::vector<Error> placeBoltPatterns(Model& model);

}  // namespace talus
