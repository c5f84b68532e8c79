#pragma once
// Time steps, as a recipe.
//
//   velocities ──┐
//   forces ──────┴─> drift ─> poses ─┬─> update contacts ─> interface wrenches ─┐
//                                    └─> update water ────> wet wrenches ───────┴─> gather ─> forces,
//                                    velocities
//
// Every stage writes slots of its own index only and reads what earlier stages wrote. So the bits do not
// depend on the cut of the ranges among threads. Between two steps gather and drift are one pass over the
// blocks.

#include <functional>

#include "state/arrays.h"

namespace talus {

/// How steps are to be computed; the result does not depend on `parallel`.
struct StepOptions {
    double time_step = 0;  ///< [s]
    bool parallel = false;
};

/// Applies the load of step `k` (from 0) of a call: tilt, level, strengths. It must not read poses,
/// velocities or forces.
using SetLoad = std::function<void(int k)>;

/// Forces for the state as it stands (at the start, or after loads changed by hand); poses and velocities
/// stay.
void updateForces(State& state, bool parallel);

/// \pre a positive time step; forces of the state as it stands
/// Steps of kick-drift-kick; the same bits however many are taken at once. No allocation.
void advance(State& state, const StepOptions& options, int steps = 1, const SetLoad& set_load = {});

}  // namespace talus
