#pragma once
// Interfaces made of what a search of pairs finds, with their contact points.

#include <vector>

#include "contacts/pair_search.h"
#include "state/arrays.h"
#include "talus/control.h"
#include "talus/result.h"

namespace talus {

/// Searches neighbours nearer than the range's margin, clips patches, places contact points. At the start
/// (`initial`) faces within kClosedGap of the block size count as closed and unstressed and deeper overlap is
/// an error; later what the contact points of a pair of faces carried and remember is handed on to its new
/// ones (contacts/carry_over.h). Asked to stop it makes none: at the start the state is to be thrown away,
/// later it is as it was.
/// \param control  asked to stop, told how far it has come
/// \param range  interfaces of pairs that it leaves out are left as they are
/// Reads:  poses, velocities, shapes, old interfaces and points
/// Writes: interfaces, points, incidence, walls of water between two blocks, search poses and margin,
///         shear_lost
/// \return faults of the model; what was asked to stop is one
std::vector<Error> makeInterfaces(State& state, const SearchRange& range, bool initial, bool parallel,
                                  const Control& control = {});

}  // namespace talus
