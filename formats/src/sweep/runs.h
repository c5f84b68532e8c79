#pragma once
// Data common to all runs of a sweep, computed once.

#include <memory>

#include "talus/formats/sweep.h"

namespace talus::formats {

/// Fills in the sweep's base, and what follows from it. \pre its columns are known
void prepareRuns(Sweep& sweep, std::shared_ptr<const Scenario> base);

}  // namespace talus::formats
