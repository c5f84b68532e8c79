#pragma once
// The steady flow in the joints of a state as it was built.

#include "state/arrays.h"
#include "talus/flow.h"

namespace talus::flow {

/// Errors: as of steadyFlow (talus/flow.h).
Result<SteadyFlow> flowIn(const State& state, const Flow& flow);

/// What users should know of parts that no head reaches; nothing where there are none.
std::optional<Error> unreachedParts(const State& state, const Flow& flow);

}  // namespace talus::flow
