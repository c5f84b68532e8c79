#pragma once
// What contact points carry and remember, handed on when their patch is clipped again.

#include "state/arrays.h"

namespace talus::stages {

struct OldInterfaces {
    Interfaces interfaces;
    ContactPoints points;
};

bool anyDilates(const std::vector<contact::JointLaw>& laws);

/// For each new interface between the same two faces as an old one: the reference gap goes with the reference face;
/// each new Lp takes the shear traction, the bond and the dilation of the nearest old one, and the tractions are shifted
/// together so that the interface's shear force stays the same. The law then cuts what Coulomb does not allow.
/// New pairs start unbonded and without shear.
/// Returns the shear force that was lost because its interface is gone or open [N].
double carryOver(const OldInterfaces& old, State& state);

}  // namespace talus::stages
