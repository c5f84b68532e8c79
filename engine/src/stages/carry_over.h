#pragma once
// What contact points carry and remember, handed on when their patch is clipped again.

#include "stages/contacts.h"
#include "state/arrays.h"

namespace talus::stages {

struct OldInterfaces {
    Interfaces interfaces;
    std::vector<std::vector<PointState>> points;  ///< per interface
};

/// Takes the interfaces out of a state, with what their Lps carry.
OldInterfaces takeInterfaces(State& state);

/// For each new interface between the same two faces as an old one: the reference gap goes with the reference face;
/// each new Lp takes the shear traction, the bond and the dilation of the nearest old one, and the tractions are shifted
/// together so that the interface's shear force stays the same. The law then cuts what Coulomb does not allow.
/// New pairs start unbonded and without shear.
/// Returns the shear force that was lost because its interface is gone or open [N].
double carryOver(const OldInterfaces& old, State& state);

}  // namespace talus::stages
