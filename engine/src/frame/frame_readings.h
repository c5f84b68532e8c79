#pragma once
// What a full frame says about contact points beyond the state: for people and pages, never for a restart.

#include "state/arrays.h"
#include "talus/frame.h"

namespace talus {

/// \pre `points` has the contact points of `interfaces`, with what they carry. Adds each contact point's
/// water share P, what it is doing, and its mobilised friction. The shares of an interface add up to the
/// water's exact thrust on the patch.
void addReadings(const State& state, const FrameInterfaces& interfaces, FramePoints& points);

}  // namespace talus
