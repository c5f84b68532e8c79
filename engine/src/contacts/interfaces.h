#pragma once
// Interfaces and contact points from the pairs that a search finds.

#include <vector>

#include "contacts/pair_search.h"
#include "state/arrays.h"
#include "talus/control.h"
#include "talus/result.h"

namespace talus {

/// Searches neighbours nearer than the range's margin, clips patches, places contact points. At the start
/// (`initial`) faces within kClosedGap of the block size count as closed and unstressed, and deeper overlap
/// is an error. Later the forces and memory of a pair's contact points pass to its new ones
/// (contacts/carry_over.h). An interruption at the start leaves a state to discard; later it leaves the state
/// unchanged.
/// \param control interruption and progress
/// \param range interfaces of pairs outside it are kept as they are
/// Reads:  poses, velocities, shapes, old interfaces and points
/// Writes: interfaces, points, incidence, walls of water between two blocks, search poses and margin,
///         shear_lost
/// \return faults of the model; an interruption is one
std::vector<Error> makeInterfaces(State& state, const SearchRange& range, bool initial, bool parallel,
                                  const Control& control = {});

}  // namespace talus
