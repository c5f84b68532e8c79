#pragma once
// The only door to the contacts: which blocks touch, where, and what their contact points remember. Called at
// the start and between steps, never inside one.

#include <vector>

#include "state/arrays.h"
#include "talus/control.h"
#include "talus/result.h"

namespace talus {

/// Searches neighbours, clips patches, places contact points. At the start (`initial`) faces within
/// kClosedGap of the block size count as closed and unstressed and deeper overlap is an error; later what the
/// contact points of a pair of faces carried and remember is handed on to its new ones.
/// Reads:  poses, velocities, shapes, old interfaces and points
/// Writes: interfaces, points, incidence, walls of water between two blocks, search poses and margin,
///         shear_lost
/// \param control  asked to stop: then that is the error, and of a state at its start nothing is to be used
std::vector<Error> findInterfaces(State& state, bool initial, bool parallel, const Control& control = {});

/// Brings the contacts up to date for the next `ahead` seconds:
///  1. when a block has come so far that a contact could be missed, or a patch has slid or turned by more
///  than a small share
///     of its size, all interfaces are found again (findInterfaces); with State::searches_around those around
///     such blocks alone;
///  2. else pairs that meet by vertices and edges are looked at again, each when it may have moved enough: a
///  contact whose vertex
///     and face are the same stays to the bit, others are placed anew. Where faces came to meet that have no
///     interface (with Springs::keep_energy: may before the next look), or no longer meet, all interfaces are
///     found again as in 1;
///  3. else contacts whose reference gap lies below where the faces are recover it, paid for with kinetic
///  energy of their two
///     blocks (contacts/gap_recovery.h).
/// Reads:  poses, velocities, shapes, laws, interfaces and points
/// Writes: 1: as findInterfaces, and the forces of contacts and water; 2: vertex and edge contacts, their
///         points, incidence;
///         3: reference gaps, velocities, angular momenta; with Springs::keep_energy also forces on blocks
/// Asked to stop while interfaces are found it leaves all as it was: then nothing may be computed further.
/// With Springs::keep_energy no energy comes of 1 (contacts/energy_balance.h), and blocks have the force of
/// what has changed.
/// \return whether interfaces were found again: then time step and inertia may have to follow
/// \param gone  how far each block has gone since the last call [m], where its velocity does not tell
/// \param may_wait  what 2 finds again in one pair of blocks only may wait until a later call
/// (updateVertexEdges)
bool refreshInterfaces(State& state, bool parallel, double ahead, const std::atomic<bool>* stop = nullptr,
                       const std::vector<double>& gone = {}, bool may_wait = false);

/// Takes free blocks out of a state at rest: they stay where they are, fixed, and touch nothing any more;
/// contacts of others are left to the bit.
/// Reads:  as findInterfaces
/// Writes: the blocks' motion, inertia, velocities and `gone`; as findInterfaces, forces of contacts and
///         water
/// \pre no bolt ties them
void takeOut(State& state, const std::vector<std::size_t>& blocks, bool parallel);

}  // namespace talus
