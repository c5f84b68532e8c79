#pragma once
// The pseudo-static earthquake: every free block feels k times its weight; water stays as it is.
//
// Reads: the model's [seismic] and gravity; load.tilt, load.horizontal, load.gravity_share

#include <optional>

#include "model/gravity.h"
#include "state/arrays.h"

namespace talus {

/// Nothing without an earthquake [m/s^2].
inline std::optional<Vec3> seismicAcceleration(const State& state) {
    const Model& model = state.geometry->model;
    if (state.load.horizontal == 0 && model.seismic.vertical == 0) return std::nullopt;
    return Vec3(model.gravity.magnitude * state.load.gravity_share *
                seismicShare(model.seismic, state.load.horizontal, model.gravity, state.load.tilt));
}

}  // namespace talus
