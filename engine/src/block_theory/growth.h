#pragma once
// From one group to a weaker one, by neighbours that it takes in and members that it leaves behind.

#include "block_theory/best_groups.h"
#include "block_theory/body_maker.h"

namespace talus::keyblocks {

/// A step adds one neighbour, all neighbours, or all that do not make the group stronger by themselves, each
/// with the blocks that must move with it. Where that finds nothing weaker it leaves out one member, with all
/// that this one stops. The weakest result continues, of equal ones the heaviest, so a group ends with all
/// blocks that fail at its factor. Adds the groups on the way to `found`. \param visits blocks that may be
/// looked at
void grow(const Slope& slope, const Group& from, std::size_t visits, BodyMaker& maker, BestGroups& found);

}  // namespace talus::keyblocks
