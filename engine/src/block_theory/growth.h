#pragma once
// From one group to a weaker one, by neighbours that it takes in and members that it leaves behind.

#include "block_theory/best_groups.h"
#include "block_theory/body_maker.h"

namespace talus::keyblocks {

/// A step takes in one neighbour, all neighbours, or all of those that do not make the group stronger by
/// themselves, each with what has to move with it. Where that leads no further it leaves one member behind,
/// with all whom that one stops. The weakest goes on, of equal ones the heaviest, so that a group ends with
/// all that goes at its factor. Adds the groups on the way to `found`. \param visits  blocks that may be
/// looked at
void grow(const Slope& slope, const Group& from, std::size_t visits, BodyMaker& maker, BestGroups& found);

}  // namespace talus::keyblocks
