#pragma once
// Invariants of a state, on which every function that takes one may rely. Debug builds check them after every
// update of the contacts (contacts/update.cpp), and tests after each test. A frame from a file must satisfy
// them before it is used (frame/frame.h).

#include <string>
#include <vector>

#include "state/arrays.h"

namespace talus {

/// Violated invariants with their place: at most Findings::kMost lines such as "interface 12: its area is not
/// positive". Empty when all hold.
///  - blocks: arrays of one size, unit quaternions, positive masses and moments of inertia, none for blocks
///    that are not free;
///  - interfaces: groups of equal corners and contact points that follow each other, with their slots and
///    nothing in unused lanes; indices within their arrays; a pair of faces once;
///  - frames: orthonormal, in the two faces' planes, from a to b;
///  - patches: convex, counter-clockwise, of the stated area;
///  - places for vertices and edges: four for a pair of blocks, idle ones carry nothing;
///  - contact points: their areas add up to the patch's, bonds in 0..1, stored places those of the rule;
///  - incidence: of each block exactly its interfaces and wet walls in their order, with side and slot;
///  - wet walls: sorted by water, polygons convex and counter-clockwise with their own moments;
///  - search: poses of as many blocks, a margin.
std::vector<std::string> validate(const State& state);

/// For a state whose interface wrenches belong to its present poses and laws. Each wrench is the sum over its
/// contact points by a new call of the law, and equal and opposite on the two blocks. Energies are not
/// negative, and the elastic one is that of the springs' lengths. With dashpots the wrench has more than
/// springs, and only its opposite is checked.
/// \pre validate(state) is empty
std::vector<std::string> validateForces(const State& state);

}  // namespace talus
