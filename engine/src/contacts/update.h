#pragma once
// The only interface to the contacts: which blocks touch, where, and what their contact points remember.
// Called at the start and between steps, never inside one.

#include <vector>

#include "state/arrays.h"
#include "talus/control.h"
#include "talus/result.h"

namespace talus {

/// Searches neighbours, clips patches, places contact points. At the start (`initial`) faces within
/// kClosedGap of the block size count as closed and unstressed, and deeper overlap is an error. Later the
/// forces and memory of a pair's contact points pass to its new ones.
/// Reads:  poses, velocities, shapes, old interfaces and points
/// Writes: interfaces, points, incidence, walls of water between two blocks, search poses and margin,
///         shear_lost
/// \param control an interruption is returned as an error; a state at its start must then be discarded
std::vector<Error> findInterfaces(State& state, bool initial, bool parallel, const Control& control = {});

/// Brings the contacts up to date for the next `ahead` seconds:
///  1. When a block has moved so far that a contact could be missed, or a patch has slid or turned by more
///     than a small share of its size, all interfaces are found again (findInterfaces); with
///     State::searches_around only those around such blocks.
///  2. Else pairs that meet by vertices and edges are looked at again, each when it may have moved enough. A
///     contact with the same vertex and face stays as it is, to the bit; others are placed anew. Where faces
///     without an interface meet, or faces no longer meet, all interfaces are found again as in 1. (With
///     Springs::keep_energy also where they may meet before the next look.)
///  3. Else contacts whose reference gap lies below the faces recover it from the kinetic energy of their
///     two blocks (contacts/gap_recovery.h).
/// Reads:  poses, velocities, shapes, laws, interfaces and points
/// Writes: 1: as findInterfaces, and the forces of contacts and water; 2: vertex and edge contacts, their
///         points, incidence;
///         3: reference gaps, velocities, angular momenta; with Springs::keep_energy also forces on blocks
/// An interruption while interfaces are found leaves all as it was: then nothing may be computed further.
/// With Springs::keep_energy step 1 adds no energy (contacts/energy_balance.h), and the forces on blocks are
/// updated.
/// \return whether interfaces were found again: then time step and inertia may have to follow
/// \param moved how far each block has moved since the last call [m], where that does not follow from its
/// velocity
/// \param may_wait a search wanted by one pair of blocks in 2 may wait for a later call (updateVertexEdges)
bool refreshInterfaces(State& state, bool parallel, double ahead, const std::atomic<bool>* stop = nullptr,
                       const std::vector<double>& moved = {}, bool may_wait = false);

/// Removes free blocks from a state in equilibrium: they stay where they are, fixed, and touch nothing.
/// Contacts of other blocks are unchanged to the bit.
/// Reads:  as findInterfaces
/// Writes: the blocks' motion, inertia, velocities and `removed`; as findInterfaces, forces of contacts and
///         water
/// \pre no bolt ties them
void takeOut(State& state, const std::vector<std::size_t>& blocks, bool parallel);

}  // namespace talus
