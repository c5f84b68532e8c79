#pragma once
// What contact points carry and remember, handed on when their patch is clipped again.

#include "contacts/vertex_edge.h"
#include "forces/contact_forces.h"
#include "state/arrays.h"

namespace talus {

/// The poses are those they still belong to.
struct OldInterfaces {
    Interfaces interfaces;
    ContactPoints points;
    /// per block near the search: its deepest closed contact point; 0 for fixed ones [m]
    std::vector<double> depth;
    /// Those that the search leaves as they are: which they are now, else -1. Empty: none.
    std::vector<std::int64_t> kept_as{};

    Contacts contacts(const State& state) const {
        return {state.blocks, interfaces, points, state.laws, state.geometry->model.points};
    }
};

/// Takes the interfaces and their contact points out of a state. \param near  by block: what the search may
/// touch; empty: all
OldInterfaces takeInterfaces(State& state, const std::vector<char>& near = {});

/// For each new interface between the same two faces as an old one: the reference gap goes with the reference
/// face; each new contact point takes the shear traction, the bond and the dilation of the nearest old one,
/// and the tractions are shifted together so that the interface's shear force stays the same. The law then
/// cuts what Coulomb does not allow. Slots for vertices and edges stay as they are. New pairs of faces start
/// unbonded, with the shear force of contacts of the same blocks that were there before, else as having slid
/// since the last look. No interface is pressed deeper than its blocks' deepest contact was: one that is
/// found late counts its gap from there until it opens. Adds the shear force that was lost because its
/// interface is gone or open to the state's.
/// \param ahead time between two looks, not negative [s]
/// \pre `old` was taken out of this state, whose interfaces are new and whose points are made (makePoints)
/// \return what contact points carried that are gone, for the places
CarriedPoints carryOver(const OldInterfaces& old, State& state, double ahead);

}  // namespace talus
