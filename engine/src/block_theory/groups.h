#pragma once
// The groups of blocks with the least factors of safety.

#include <vector>

#include "block_theory/group.h"
#include "block_theory/slope.h"
#include "talus/analysis.h"

namespace talus::keyblocks {

struct GroupSearch {
    std::vector<Group> groups;       ///< in that order, as BestGroups keeps them
    std::vector<Group> curve;        ///< those that carry no others, as VolumeFront keeps them
    std::size_t directions = 0;      ///< tried for every block
    std::size_t judged = 0;          ///< bodies, each once a direction
    std::size_t left_out = 0;        ///< closures not visited, by the work limit
    std::size_t curve_left_out = 0;  ///< groups of the curve alone, likewise
    bool interrupted = false;
};

/// Groups that are tested:
///  1. each block alone;
///  2. the closure of each block along each direction of `directionsOf`, small ones first, within kMostVisits;
///  3. along each direction all movable blocks, by connected pieces;
///  4. from the weakest of these, groups with more neighbours and fewer members, as long as that weakens them
///     (growth.h). Halves of a wedge, or of a slab held by cohesion, are stronger than the whole.
/// Groups that may be listed include the blocks they carry (BodyMaker::settled). The factor of each is exact
/// for its body. It is not proved that no weaker group exists: their number grows exponentially.
/// \param curve  the weakest by volume, too; it changes nothing of `groups`
GroupSearch leastGroups(const Slope& slope, const std::vector<Joint>& joints, std::size_t most, bool curve,
                        bool parallel, const Control& control);

}  // namespace talus::keyblocks
