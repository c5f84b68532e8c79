#pragma once
// No energy comes of a search: what the springs hold afterwards they held before.

#include <cstdint>
#include <utility>
#include <vector>

#include "forces/contact_forces.h"
#include "state/arrays.h"

namespace talus {

/// What the springs between two blocks hold [J].
struct PairEnergy {
    std::pair<std::int32_t, std::int32_t> blocks;  ///< the lower index first
    double energy = 0;
};

/// All pairs that hold any, sorted.
std::vector<PairEnergy> energyOfPairs(const Contacts& contacts);

/// A search changes areas, contact normals and which faces and vertices carry while they are pressed
/// together. A pair that would hold more than before takes the difference from what other contacts of its two
/// blocks no longer hold (a block that slides off one neighbour and onto another), and counts its gap from
/// less deep by as much as is still lacking. One that would hold less gets back from that what an earlier
/// search took off, as far as the energy reaches.
/// \param before of the same poses
/// Reads:  poses, laws, interfaces and points
/// Writes: reference gaps; the offsets of pairs whose shear springs alone would hold more
void balanceEnergy(State& state, const std::vector<PairEnergy>& before);

}  // namespace talus
