#pragma once
// Where blocks meet by vertices and edges (contacts/vertex_edge_points.h). A pair of convex parts that may
// meet so before the next search has a group of interfaces of one corner and one contact point each, its
// places; those that touch nothing are idle: so far open that they carry nothing. The kernel passes over
// groups in which all are.

#include <map>
#include <utility>
#include <vector>

#include "contacts/vertex_edge_points.h"
#include "forces/contact_forces.h"
#include "state/arrays.h"

namespace talus {

/// What a contact point that is gone carried, for the pair's next contact there.
struct CarriedPoint {
    Vec3 place = Vec3::Zero();   ///< [m]
    Vec3 normal = Vec3::Zero();  ///< from the block with the lower index to the other
    Vec3 shear = Vec3::Zero();   ///< on the other [N]
    double energy = 0;           ///< of the normal spring [J]
    double shear_energy = 0;     ///< of the shear spring [J]
};
/// By pairs of parts (partsOf).
using CarriedPoints = std::map<std::pair<std::int32_t, std::int32_t>, std::vector<CarriedPoint>>;

/// What the closed contact points of an interface carry [N, J].
std::vector<CarriedPoint> carriedPoints(const Contacts& contacts, std::size_t interface);

/// Appends the idle places of a pair of parts. \pre it has none yet
void appendVertexEdgePlaces(State& state, std::int32_t part_1, std::int32_t part_2);

/// What a look at the places finds.
struct PlaceChanges {
    bool places = false;  ///< some touch elsewhere than before
    /// a contact of faces has become one of a vertex or edge or the other way round, which only a new search
    /// (contacts/interfaces.h) can bring about
    bool search = false;
};

/// Looks at every pair with places again. A contact at the same vertex and face stays as it is, to the bit;
/// others take over the shear force of what was there before, and no more energy than it had: a contact found
/// late is not pressed into its new place, but counts its gap from where it is until it opens.
/// \param ahead   time until the next look, not negative [s]
/// \param gone    how far each block has gone since the last look [m]; empty: as far as its velocity takes it
/// in `ahead`
/// \param may_wait  asks for no search: faces without an interface are carried by their vertices, patches
/// stay as they are, and
///                  the pair is looked at again when it has gone as far once more
/// \pre incidence is that of the interfaces
/// Reads:  poses, velocities, shapes
/// Writes: places, their contact points, incidence
/// \param wanting  blocks, not fixed, of pairs that ask for a search are marked in it; null: nobody wants to
/// know
PlaceChanges updateVertexEdges(State& state, double ahead, bool parallel,
                               const std::vector<double>& gone = {}, bool may_wait = false,
                               std::vector<char>* wanting = nullptr);

/// The same just after a search. \param carried contact points that are gone beside those of the places
/// \param around  by block: pairs of which neither is marked stay as they are; empty: none does
void renewVertexEdges(State& state, double ahead, bool parallel, const CarriedPoints& carried,
                      const std::vector<char>& around = {});

}  // namespace talus
