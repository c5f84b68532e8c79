#pragma once
// The start of a search: weight, then water, at its first load.

#include "analysis/probing.h"

namespace talus::analysis {

/// Brings weight and water on, and keeps what they settle. What fails is watched on patiently and then tried once more from the
/// beginning, slowly.
Verdict loadGravityAndWater(Probing& probing);

/// Whether what went on under its full weight and was not borne out comes to rest where it has got to.
bool restsAfterAll(Probing& probing);

}  // namespace talus::analysis
