#pragma once
// How the corners of patches and the contact points on them are laid out in memory, group by group
// (interface_group.h).

#include <vector>

#include "law/points.h"
#include "state/arrays.h"

namespace talus {

/// Puts the next interface into a group: the last one if it has room and the shape is the same, else a new
/// one.
/// \pre corners >= 3, or one corner and one point
void addToGroups(Interfaces& interfaces, std::size_t corners, std::size_t points);

/// Makes room for the corners of an interface whose group is known.
void growCorners(Interfaces& f, std::size_t i);

/// Stores the patch of an interface whose group is known and has as many corners; corners counter-clockwise
/// from its origin along e1, e2 [m].
void placeCorners(Interfaces& f, std::size_t i, const std::vector<Eigen::Vector2d>& outline);

/// The corners again.
std::vector<Eigen::Vector2d> patchOutline(const Interfaces& interfaces, std::size_t interface);

/// The contact point of a vertex or edge contact, whose patch has one corner. It stands for the interface's
/// whole area.
contact::PatchPoint onlyPoint(const Interfaces& interfaces, std::size_t interface);

/// The contact points of an interface.
std::vector<contact::PatchPoint> interfacePoints(const Interfaces& interfaces, std::size_t interface,
                                                 const PointRule& rule);

/// contact points of every interface: unbroken, unslid.
void makePoints(State& state);

}  // namespace talus
