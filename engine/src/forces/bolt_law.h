#pragma once
// The force of one segment of a bolt: elastic, perfectly plastic by yield of the bar or slip of its grout,
// and rupture.
//
// Free between its ends: k = E A / L. Grouted: a bar of rigidity E A in grout of bond stiffness k_b [N/m per
// m], bonded over a length L on one side of a joint, obeys E A w'' = k_b w. Pulled at the joint, its other
// end free, it gives k = sqrt(E A k_b) tanh(L sqrt(k_b / (E A))) (Farmer 1975, Int. J. Rock Mech. 12:
// 347-351); held by a plate there, coth in place of tanh. The two sides of a joint are in series. Axial force
// and dowel action are taken independently, each with a strength of its own (Lorig 1985, local
// reinforcement).

#include <algorithm>
#include <cmath>

#include "state/bolt_arrays.h"

namespace talus::bolt {

/// Of a bar pulled out of one side of a joint [N/m].
inline double embeddedStiffness(double rigidity, double bond_stiffness, double length, bool held_by_plate) {
    const double share = std::tanh(length * std::sqrt(bond_stiffness / rigidity));
    const double endless = std::sqrt(rigidity * bond_stiffness);
    return held_by_plate ? endless / share : endless * share;
}

inline double inSeries(double one, double other) { return one * other / (one + other); }

/// A bar across its axis yields at 1/sqrt(3) of its tensile force (von Mises).
inline double dowelStrength(double yield_force) { return yield_force / std::sqrt(3.0); }

/// The axial force a segment can carry while `share` of its pretension is there [N].
inline double axialStrength(const BoltLaw& law, double share) {
    return std::min(law.yield, law.bond + share * law.pretension);
}

struct AxialForce {
    double force = 0;  ///< tension [N]; a bar that is pressed bends aside
    double slope = 0;  ///< by the elongation [N/m]
};

/// At an elongation [m]; updates `memory`. A bolt that breaks holds to the end of this call; `memory` records
/// the rupture.
inline AxialForce axialForce(const BoltLaw& law, double elongation, double share, BoltMemory& memory) {
    if (memory.broken) return {};
    const double trial =
        share * law.pretension + law.stiffness * (elongation - memory.yielded - memory.slipped);
    if (trial <= 0) return {};
    const double strength = axialStrength(law, share);
    const double force = std::min(trial, strength);
    if (trial > strength)
        (strength < law.yield ? memory.slipped : memory.yielded) += (trial - strength) / law.stiffness;
    // The plastic elongation is spread over the elastic length E A / k.
    memory.broken = (force + law.stiffness * memory.yielded) / law.rigidity > law.rupture_strain;
    return {force, trial > strength ? 0.0 : law.stiffness};
}

struct DowelForce {
    Vec3 force = Vec3::Zero();  ///< on b [N]
    Mat3 slope = Mat3::Zero();  ///< minus its derivative by the displacement [N/m]
};

/// At a displacement of b across the axis, in a's own frame [m].
inline DowelForce dowelForce(const BoltLaw& law, const Vec3& axis, const Vec3& across, BoltMemory& memory) {
    if (memory.broken || law.dowel_stiffness == 0) return {};
    const Vec3 trial = -law.dowel_stiffness * (across - memory.dowel);
    const Mat3 plane = Mat3::Identity() - axis * axis.transpose();
    const double size = trial.norm();
    if (size <= law.dowel_strength) return {trial, law.dowel_stiffness * plane};
    const Vec3 way = trial / size, force = law.dowel_strength * way;
    memory.dowel = across + force / law.dowel_stiffness;
    return {force, law.dowel_stiffness * law.dowel_strength / size * (plane - way * way.transpose())};
}

/// Elastic energy of the forces [J].
inline double storedEnergy(const BoltLaw& law, double axial, const Vec3& dowel) {
    const double across = law.dowel_stiffness > 0 ? dowel.squaredNorm() / law.dowel_stiffness : 0.0;
    return 0.5 * (axial * axial / law.stiffness + across);
}

}  // namespace talus::bolt
