#pragma once
// Stage "update patches": which faces lie against each other, and where their contact points are. Runs at the start
// and whenever something has moved far enough to matter; never inside the hot loop.

#include <vector>

#include "state/arrays.h"
#include "talus/result.h"

namespace talus::stages {

/// Of the smaller block's size: faces nearer than this are closed and unstressed at the start.
inline constexpr double kClosedGap = 1e-4;

/// Searches neighbours, clips patches, places contact points. At the start (`initial`) faces within 1e-4 of the block
/// size count as closed and unstressed and deeper overlap is an error; later what the Lps of a pair of faces carried
/// and remember is handed on to its new ones.
/// Reads:  poses, shapes, old interfaces and points
/// Writes: interfaces, points, incidence, search poses
std::vector<Error> findInterfaces(State& state, bool initial, bool parallel);

/// Finds interfaces again when a block has come so far that a contact could be missed within the next `ahead` seconds,
/// or an interface has slid or turned by more than a small share of its size. True when it did.
bool refreshInterfaces(State& state, bool parallel, double ahead);

/// Finds which interfaces push on which block. Reads interfaces, writes their part of incidence.
void buildIncidence(State& state);

/// Joint of an interface between two faces: the pair's own, else that of the face with less friction.
std::int32_t interfaceJoint(const Geometry& geometry, std::size_t block_a, std::size_t face_a,
                            std::size_t block_b, std::size_t face_b);

/// The interface of two blocks, the one with the largest patch if there are several; -1 when they share none.
std::int32_t largestInterface(const State& state, std::int32_t block_1, std::int32_t block_2);

}  // namespace talus::stages
