#pragma once
// Quantities of contact points in a full frame beyond the state: for results and pages, never for a restart.

#include "state/arrays.h"
#include "talus/frame.h"

namespace talus {

/// \pre `points` has the contact points of `interfaces`, with their forces. Adds each contact point's water
/// share P, its state (open, sticking, slipping) and its mobilised friction. The shares of an interface add
/// up to the water's exact thrust on the patch.
void addReadings(const State& state, const FrameInterfaces& interfaces, FramePoints& points);

}  // namespace talus
