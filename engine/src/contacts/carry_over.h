#pragma once
// Transfer of the forces and memory of contact points when their patch is clipped again.

#include "contacts/vertex_edge.h"
#include "forces/contact_forces.h"
#include "state/arrays.h"

namespace talus {

/// Interfaces from before a search; the state still has the poses they belong to.
struct OldInterfaces {
    Interfaces interfaces;
    ContactPoints points;
    /// per block near the search: its deepest closed contact point; 0 for fixed ones [m]
    std::vector<double> depth;
    /// New index of each interface that the search leaves as it is, else -1. Empty: none.
    std::vector<std::int64_t> kept_as{};

    Contacts contacts(const State& state) const {
        return {state.blocks, interfaces, points, state.laws, state.geometry->model.points};
    }
};

/// Moves the interfaces and their contact points out of a state. \param near by block: those that the search
/// may change; empty: all
OldInterfaces takeInterfaces(State& state, const std::vector<char>& near = {});

/// For each new interface between the same two faces as an old one, the reference gap moves with the
/// reference face. Each new contact point takes the shear traction, bond and dilation of the nearest old one.
/// The tractions are shifted together to keep the interface's shear force. The law then cuts forces beyond
/// the strength. Slots for vertices and edges stay as they are. New pairs of faces start unbonded, with the
/// shear force of former contacts of the same blocks, else as having slid since the last look. No interface
/// is pressed deeper than its blocks' deepest contact was: one found late counts its gap from there until it
/// opens. Shear force of interfaces that vanished or opened is added to State::shear_lost.
/// \param ahead time between two looks, not negative [s]
/// \pre `old` was taken out of this state, whose interfaces are new and whose points are made (makePoints)
/// \return forces of the contact points that vanished, for the places
CarriedPoints carryOver(const OldInterfaces& old, State& state, double ahead);

}  // namespace talus
