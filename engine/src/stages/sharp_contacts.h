#pragma once
// Stage "update sharp contacts": where blocks meet by vertices and edges (detection/sharp_contacts.h). A pair of blocks
// that may meet so before the next search has a group of interfaces of one corner and one Lp each, its slots; those
// that touch nothing are idle: so far open that they carry nothing. The kernel treats them like all others.

#include <map>
#include <utility>
#include <vector>

#include "detection/sharp_contacts.h"
#include "stages/contacts.h"
#include "state/arrays.h"

namespace talus::stages {

/// Faces meet as faces up to this angle from parallel, and the more the deeper they are pressed into each other (per share
/// of the smaller block's size) [rad]. Beyond that only the patch's lowest edge or vertex carries (the Lps next to it lie
/// a sixth of the patch away), so a contact of faces and one of a vertex or edge take over from each other without a jump.
inline constexpr double kFaceAngle = 0.05;
inline constexpr double kFaceAnglePerDepth = 10.0;

/// A patch with less area than one Lp at a vertex is too soft to carry for long: pressed deeper than this (share of the
/// smaller block's size) it leaves that to the vertices and edges.
inline constexpr double kSliverDepth = 1e-4;

/// What an Lp that is gone carried, for the pair's next contact there.
struct CarriedPoint {
    Vec3 place = Vec3::Zero();   ///< [m]
    Vec3 normal = Vec3::Zero();  ///< from the block with the lower index to the other
    Vec3 shear = Vec3::Zero();   ///< on the other [N]
    double energy = 0;           ///< of the normal spring [J]
};
using CarriedPoints = std::map<std::pair<std::int32_t, std::int32_t>, std::vector<CarriedPoint>>;

/// What the closed Lps of an interface carry [N, J].
std::vector<CarriedPoint> carriedPoints(const Contacts& contacts, std::size_t interface);

/// Whether an interface is a slot for a vertex or an edge, and whether that slot touches nothing.
bool isSharp(const Interfaces& interfaces, std::size_t interface);
bool isIdle(const Interfaces& interfaces, std::size_t interface);

/// Interfaces and their Lps without idle slots.
struct ContactCount {
    std::size_t interfaces = 0, points = 0;
};
ContactCount countContacts(const Interfaces& interfaces);

/// What counts as a meeting of two blocks by vertices or edges that may go this far before the next look [m].
SharpLimits sharpLimits(const Geometry& geometry, std::size_t block_1, std::size_t block_2, double reach);

/// Area that an Lp at a vertex or a crossing of edges stands for: that of a vertex Lp on a four-cornered face of the two
/// blocks' lesser mean face area (A/24 with `vertex` points, A/4 with `corner` and `quarter`, A/N^2 with `grid N`) [m^2].
double sharpArea(const Geometry& geometry, std::size_t block_1, std::size_t block_2);

/// Appends the idle slots of a pair of blocks.
void appendSharpSlots(State& state, std::int32_t block_1, std::int32_t block_2);

/// Looks at every pair with slots again. A contact at the same vertex and face stays as it is, to the bit; others take
/// over the shear force of what was there before, and no more energy than it had: a contact found late is not pressed
/// into its new place, but counts its gap from where it is until it opens.
/// \param ahead   time until the next look [s]
/// Reads:  poses, velocities, shapes
/// Writes: slots, their Lps, incidence
/// \return whether a contact of faces has become one of a vertex or edge or the other way round, which only a new search
///         (patches.h) can bring about
bool updateSharpContacts(State& state, double ahead, bool parallel);

/// The same just after a search. \param carried Lps that are gone beside those of the slots
void renewSharpContacts(State& state, double ahead, bool parallel, const CarriedPoints& carried);

}  // namespace talus::stages
