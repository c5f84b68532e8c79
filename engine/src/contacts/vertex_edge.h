#pragma once
// Where blocks meet by vertices and edges (contacts/vertex_edge_points.h). A pair of convex parts that may
// meet so before the next search has a group of interfaces of one corner and one contact point each, its
// places. Places that touch nothing are idle: too far open to carry anything. The kernel skips groups in
// which all are idle.

#include <map>
#include <utility>
#include <vector>

#include "contacts/vertex_edge_points.h"
#include "forces/contact_forces.h"
#include "state/arrays.h"

namespace talus {

/// Force of a vanished contact point, for the pair's next contact there.
struct CarriedPoint {
    Vec3 place = Vec3::Zero();   ///< [m]
    Vec3 normal = Vec3::Zero();  ///< from the block with the lower index to the other
    Vec3 shear = Vec3::Zero();   ///< on the other [N]
    double energy = 0;           ///< of the normal spring [J]
    double shear_energy = 0;     ///< of the shear spring [J]
};
/// By pairs of parts (partsOf).
using CarriedPoints = std::map<std::pair<std::int32_t, std::int32_t>, std::vector<CarriedPoint>>;

/// Forces and energies of an interface's closed contact points [N, J].
std::vector<CarriedPoint> carriedPoints(const Contacts& contacts, std::size_t interface);

/// Appends the idle places of a pair of parts. \pre it has none yet
void appendVertexEdgePlaces(State& state, std::int32_t part_1, std::int32_t part_2);

/// Result of a look at the places.
struct PlaceChanges {
    bool places = false;  ///< some touch elsewhere than before
    /// a contact of faces has become one of a vertex or edge or the reverse, which needs a new search
    /// (contacts/interfaces.h)
    bool search = false;
};

/// Updates the places of every pair. A contact at the same vertex and face stays as it is, to the bit. Others
/// take over the shear force of the contact before them, and no more energy than it had. A contact found late
/// is not moved into overlap: its gap counts from where it is until it opens.
/// \param ahead   time until the next look, not negative [s]
/// \param moved displacement of each block since the last look [m]; empty: its velocity times `ahead`
/// \param may_wait  wants no search: vertices carry faces without an interface, patches stay, and the pair is
///                  looked at again after the same displacement
/// \pre incidence is that of the interfaces
/// Reads:  poses, velocities, shapes
/// Writes: places, their contact points, incidence
/// \param wanting marks the blocks, not fixed, of pairs that need a search; may be null
PlaceChanges updateVertexEdges(State& state, double ahead, bool parallel,
                               const std::vector<double>& moved = {}, bool may_wait = false,
                               std::vector<char>* wanting = nullptr);

/// The same just after a search. \param carried vanished contact points beside those of the places
/// \param around  by block: pairs of which neither is marked stay as they are; empty: none does
void renewVertexEdges(State& state, double ahead, bool parallel, const CarriedPoints& carried,
                      const std::vector<char>& around = {});

}  // namespace talus
