#pragma once
// The wrench of one interface and its exact derivative by the poses of its two blocks: law, lever arms and turning
// frames.

#include <Eigen/Core>
#include <span>

#include "law/law.h"
#include "talus/polyhedron.h"

namespace talus::equilibrium {

using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

/// Where a block is: its centroid and the turn from its own frame to the model's.
struct Placed {
    Vec3 position = Vec3::Zero();  ///< [m]
    Mat3 turn = Mat3::Identity();
};

/// A contact point as the solver keeps it; its memory is that of the last committed step.
struct SolverPoint {
    double xi = 0, eta = 0;  ///< on the patch, from the interface's origin along e1, e2 [m]
    double area = 0;         ///< A_s [m^2]
    contact::PointMemory memory{};
};

/// An interface's frames in the own frames of its blocks (state/interface_frame.h).
struct InterfacePlace {
    Vec3 origin_a, e1_a, e2_a;
    Vec3 origin_b, e1_b, e2_b;
    Vec3 reference_gap;
};

/// On each block: force, then moment about its centroid, model frame [N, N m].
struct InterfaceWrenches {
    Vec6 on_a = Vec6::Zero(), on_b = Vec6::Zero();
    bool carries = false;  ///< else no contact point is closed
};

/// Derivatives of the two wrenches by displacement and rotation (a small turn in the model frame) of the two blocks.
struct InterfaceStiffness {
    Mat6 aa, ab, ba, bb;  ///< "ab": of the wrench on a, by the motion of b
};

/// \param rounding see normalResponse [N]
/// \param stiffness null when only the wrenches are wanted; written where the interface carries
InterfaceWrenches interfaceResponse(const InterfacePlace& place, const Placed& a, const Placed& b,
                                    const contact::JointLaw& joint, std::span<const SolverPoint> points,
                                    double rounding, InterfaceStiffness* stiffness);

/// Slides along e1, e2 and gap at a contact point [m].
Vec3 slidesAndGap(const InterfacePlace& place, const Placed& a, const Placed& b, const SolverPoint& point);

/// Makes the plastic slides of these poses those of the points, for the rounded law (the exact one commits in the
/// kernel).
void commitSlides(const InterfacePlace& place, const Placed& a, const Placed& b,
                  const contact::JointLaw& joint, std::span<SolverPoint> points, double rounding);

}  // namespace talus::equilibrium
