#pragma once
// Joint sets whose joints end at the planes of another joint: cross joints between beds, bedding on either
// side of a fault.

#include <vector>

#include "talus/rock_mass.h"

namespace talus {

/// A set that is placed anew between each two neighbouring planes of another joint.
struct EndingSet {
    JointSet set;             ///< its origin and offset mean nothing
    std::size_t ends_at = 0;  ///< index into the sets of the rock mass, then its singles
};

/// Its joints as rectangles (`of_network`) that reach from one plane of the other joint to the next and cross
/// the region along it. Between each two planes the set begins at a random place, drawn from the seed.
/// \param index  tells ending sets apart: each has random numbers of its own
/// Errors ("joint_set[i].ends_at" and others of the set): the other joint is parallel, scattered or finite;
/// more than a million joints; those of jointPlanes. \pre a sound region
Result<std::vector<SingleJoint>> endingJoints(const EndingSet& ending, std::size_t index,
                                              const RockMass& description);

}  // namespace talus
