#pragma once
// Stage "update contacts": plastic slides and interface wrenches from the poses.

#include <vector>

#include "forces/contact_view.h"
#include "state/arrays.h"
#include "state/point_layout.h"
#include "state/range.h"

namespace talus {

/// \pre  groups of the state; interfaces, points and block poses are those of one instant; with contact
///       damping angular_velocity too
/// Reads:  blocks.position, orientation (and velocity, angular_velocity with contact damping); interfaces'
///         frames and
///         patches; laws; release
/// Writes: points' memory; interfaces.force, moment_a, moment_b
/// Each group of interfaces writes its own slots only.
void updateContacts(State& state, Range groups);

/// How kernels find the contact points, whether those share the closed part of a patch that is partly open,
/// and whether the strength of some joint is a curve.
PointPlaces pointPlaces(const State& state);
bool isDistributed(const State& state);
bool hasCurves(const State& state);

/// Gap at the interface's origin and its slopes along e1 and e2, less the reference gap [m, -, -], and the
/// slide of b over a there along e1, e2 [m] with its gradients.
struct RelativePose {
    Vec3 gap;               ///< gap, d gap/d xi, d gap/d eta
    Vec3 slide_1, slide_2;  ///< likewise
    Vec3 origin;            ///< of the interface, model frame [m]
    Vec3 e1, e2, e3;        ///< model frame
};
RelativePose relativePose(const PositionArray& position, const QuaternionArray& orientation,
                          const Interfaces& interfaces, std::size_t interface);
RelativePose relativePose(const Blocks& blocks, const Interfaces& interfaces, std::size_t interface);
RelativePose relativePose(const State& state, std::size_t interface);

/// A contact point: its place on the patch, its forces and its memory.
struct ContactPoint {
    Eigen::Vector2d position;   ///< along e1, e2 from the interface's origin [m]
    double area;                ///< A_s [m^2]
    double gap;                 ///< that the law takes; with the rule "distributed" that of its share [m]
    contact::PointForce force;  ///< of the springs, on b
    contact::PointMemory memory;
    double cohesive = 1;  ///< share of its area that has cohesion: with that rule the closed one
};

/// Whether a patch is closed in one part and open in another.
bool isPartlyOpen(const State& state, std::size_t interface);

/// Input of the forces at contact points: interfaces and contact points of a state, or those before a search.
struct Contacts {
    const Blocks& blocks;
    const Interfaces& interfaces;
    const ContactPoints& points;
    const std::vector<contact::JointLaw>& laws;
    const PointRule& rule;
};
Contacts contactsOf(const State& state);

/// All contact points of an interface, in the order of contact::patchPoints. A second call of the law at the
/// same place gives the same forces (except that dilation of a slip acts from the next step on).
std::vector<ContactPoint> contactPoints(const Contacts& contacts, std::size_t interface);
std::vector<ContactPoint> contactPoints(const State& state, std::size_t interface);

/// Energy of the springs of an interface's contact points [J].
double storedEnergy(const Contacts& contacts, std::size_t interface);

}  // namespace talus
