#pragma once
// Interfaces by kind, block and faces.

#include "state/arrays.h"

namespace talus {

/// Interfaces that a pair of blocks has for its vertices and edges, if it has any.
inline constexpr std::size_t kPlacesOfPair = 4;

/// Whether an interface is a place for a vertex or an edge, and whether that place touches nothing now.
bool isVertexEdge(const Interfaces& interfaces, std::size_t interface);
bool isIdle(const Interfaces& interfaces, std::size_t interface);

/// Records whether all places of a group are idle; their forces are zero then.
/// Reads: idle. Writes: the group, its wrenches
void markIdle(Interfaces& interfaces, std::size_t group);

/// Interfaces and their contact points without idle places.
struct ContactCount {
    std::size_t interfaces = 0, points = 0;
};
ContactCount countContacts(const Interfaces& interfaces);

/// Finds which interfaces push on which block. Reads interfaces, writes their part of incidence.
void buildIncidence(State& state);

/// Largest length in the differences that give a block's gaps: its own coordinates, and those of its
/// neighbours with the arms to the contact. A gap is rounded by that times the rounding of one [m].
double coordinateReach(const State& state, const PositionArray& position, std::size_t block);

/// The interface of two blocks, the one with the largest patch if there are several; -1 when they share none.
std::int32_t largestInterface(const State& state, std::int32_t block_1, std::int32_t block_2);

/// The interface of two faces; -1: they have none.
std::int32_t interfaceOfFaces(const State& state, std::int32_t block_1, std::int32_t face_1,
                              std::int32_t block_2, std::int32_t face_2);

}  // namespace talus
