#pragma once
// Data common to all runs of a sweep, computed once.

#include <memory>

#include "talus/formats/sweep.h"

namespace talus::formats {

/// What a distribution gives at a share of it: a number, or a whole one. \pre as of `quantile`
SweepValue drawnValue(const Distribution& distribution, double share);

/// Fills in the sweep's base, and what follows from it. \pre its columns are known
void prepareRuns(Sweep& sweep, std::shared_ptr<const Scenario> base);

}  // namespace talus::formats
