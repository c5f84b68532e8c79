#pragma once
// A search for contacts adds no energy: springs hold no more after it than before.

#include <cstdint>
#include <utility>
#include <vector>

#include "forces/contact_forces.h"
#include "state/arrays.h"

namespace talus {

/// Energy of the springs between two blocks [J].
struct PairEnergy {
    std::pair<std::int32_t, std::int32_t> blocks;  ///< the lower index first
    double energy = 0;
};

/// All pairs that hold any, sorted.
std::vector<PairEnergy> energyOfPairs(const Contacts& contacts);

/// A search changes areas, contact normals, and which faces and vertices carry, while they are pressed
/// together. A pair that would hold more takes the difference from what other contacts of its two blocks have
/// lost, as where a block slides off one neighbour onto another. For what is still lacking its reference gap
/// is lowered. A pair that would hold less recovers overlap that an earlier search took off, as far as that
/// energy allows.
/// \param before of the same poses
/// Reads:  poses, laws, interfaces and points
/// Writes: reference gaps; the offsets of pairs whose shear springs alone would hold more
void balanceEnergy(State& state, const std::vector<PairEnergy>& before);

}  // namespace talus
