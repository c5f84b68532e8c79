#pragma once
// One time step, as a recipe.
//
//   velocities ──┐
//   forces ──────┴─> drift ─> poses ─┬─> update contacts ─> interface wrenches ─┐
//                                    └─> update water ────> wet wrenches ───────┴─> gather ─> forces, velocities
//
// Every stage writes slots of its own index only and reads what earlier stages wrote, so the cut of the ranges among
// threads does not show in a single bit.

#include "state/arrays.h"

namespace talus::stages {

/// How a step is to be computed; the result does not depend on `parallel`.
struct StepOptions {
    double time_step = 0;  ///< [s]
    bool parallel = false;
};

/// Forces for the state as it stands (at the start, or after loads changed by hand); poses and velocities stay.
void updateForces(State& state, bool parallel);

/// One step of kick-drift-kick. No allocation.
void advance(State& state, const StepOptions& options);

}  // namespace talus::stages
