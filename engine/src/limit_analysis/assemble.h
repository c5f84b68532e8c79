#pragma once
// From a state as `buildState` gives it to the assembly of limit analysis, and the loads on that.

#include <string>
#include <vector>

#include "limit_analysis/assembly.h"
#include "state/arrays.h"

namespace talus::limit {

/// Bodies and closed contact points of a state as `buildState` gives it. Joints without bond need only the
/// outermost points of a patch: a force inside their hull is a sum of forces at them, within their strength.
/// Blocks named in `left_out` are removed.
Assembly assemble(const State& state, const std::vector<std::string>& left_out);

/// The blocks' masses in a field of this acceleration [m/s^2].
Loads weightLoads(const State& state, const Assembly& assembly, const Vec3& acceleration);

/// The blockForces on them at a tilt [rad], which becomes the state's tilt.
Loads appliedLoads(State& state, const Assembly& assembly, double tilt);

}  // namespace talus::limit
