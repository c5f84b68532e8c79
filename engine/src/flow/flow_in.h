#pragma once
// The steady flow in the joints of a state as it was built, and with apertures of its own.

#include <vector>

#include "flow/network.h"
#include "flow/solve.h"
#include "flow/upstream.h"
#include "state/arrays.h"
#include "talus/flow.h"

namespace talus::flow {

/// Errors: as of steadyFlow (talus/flow.h).
Result<SteadyFlow> flowIn(const State& state, const Flow& flow, const Telling& telling = {});

/// The joints of a model as it was built, with apertures that are linear on each triangle.
struct Joints {
    const Network& network;
    std::vector<Corners> aperture;  ///< hydraulic, at the corners of each triangle [m]
    double tilt = 0;                ///< of gravity [rad]
};
/// Errors: likewise.
Result<SteadyFlow> flowThrough(const Joints& joints, const State& state, const Flow& flow,
                               const Telling& telling = {});

/// At the corners of each triangle, as the model gives them [m].
std::vector<Corners> statedApertures(const Network& network, const Flow& flow);

/// What users should know of parts that no head reaches, and of water that can leave nowhere.
std::vector<Error> doubtsOf(const State& state, const Flow& flow);

}  // namespace talus::flow
