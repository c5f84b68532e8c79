#pragma once
// The start of a search: weight, then water, at its first load.

#include <functional>

#include "analysis/probing.h"

namespace talus::analysis {

/// Brings weight and water on, and keeps what they settle. What fails under its weight by explicit steps, and has no rest that the
/// implicit solve finds, is let go; where it is not seen to fail then, it is watched on patiently and tried once more from the
/// beginning, slowly.
/// \param is_seen_to_fail  lets the moving state go; keeps it as it was when it says no
Verdict loadGravityAndWater(Probing& probing, const std::function<bool()>& is_seen_to_fail);

/// Whether what went on under its full weight and was not borne out comes to rest where it has got to.
bool restsAfterAll(Probing& probing);

}  // namespace talus::analysis
