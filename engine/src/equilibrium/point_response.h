#pragma once
// The contact law at one contact point together with its derivative, for Newton's method: what law/law.h gives
// for a trial pose while nothing is committed, and how it changes with the pose.

#include <Eigen/Core>
#include <cmath>

#include "law/law.h"

namespace talus::equilibrium {

/// Forces at a contact point and their derivative by the relative displacement of its two sides, both along e1, e2,
/// e3 (e3: normal; the force acts on b, the gap is positive when open).
struct PointResponse {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();      ///< F_s1, F_s2, F_n [N]
    Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();  ///< d force / d (slide_1, slide_2, gap) [N/m]
    bool open = false, slips = false;
};

/// Normal force and its derivative by the trial force -k_n A (gap - dilation).
struct NormalResponse {
    double force = 0;  ///< compression positive [N]
    double slope = 0;
};

/// eqs 5 and 7. With `rounding` > 0 [N] an unbonded contact point's corner between open and closed is a hyperbola
/// that lies rounding/2 above it: a path for Newton's method through contacts that open and close, never the answer.
inline NormalResponse normalResponse(double trial, double tension_limit, double rounding) {
    if (tension_limit > 0)
        return trial > -tension_limit ? NormalResponse{trial, 1.0} : NormalResponse{-tension_limit, 0.0};
    if (rounding > 0) {
        const double root = std::sqrt(trial * trial + rounding * rounding);
        // The conjugate form: the plain sum loses everything where the contact point is wide open.
        const double force = trial > 0 ? 0.5 * (trial + root) : 0.5 * rounding * rounding / (root - trial);
        return {force, force / root};
    }
    return trial < 0 ? NormalResponse{} : NormalResponse{trial, 1.0};
}

/// The law and its exact derivative at a gap and slide, its memory being that of the last equilibrium. Bonds hold
/// what they have left: one that is overloaded gives at its strength, and breaks when the step is committed. The
/// derivative is unsymmetric where the contact point slips: its shear force follows the normal force, not the other
/// way round.
inline PointResponse pointResponse(const contact::JointLaw& joint, double area, double slide_1,
                                   double slide_2, double gap, const contact::PointMemory& memory,
                                   double rounding) {
    PointResponse point;
    const contact::StiffnessOf<double> sticking = contact::stiffnessOf(joint);
    const double normal_stiffness = sticking.normal * area, stiffness = sticking.shear * area;
    const double tension_limit = contact::tensileStrength(joint, area, memory.bond);
    const double trial_normal = -normal_stiffness * (gap - memory.dilation);
    point.open = trial_normal < 0 && tension_limit == 0 && !(rounding > 0);
    if (point.open) return point;
    const NormalResponse normal = normalResponse(trial_normal, tension_limit, rounding);
    point.force.z() = normal.force;
    point.stiffness(2, 2) = -normal.slope * normal_stiffness;
    const double back_1 = memory.offset_1 - slide_1, back_2 = memory.offset_2 - slide_2;
    const double strength = contact::shearStrength(joint, area, normal.force, memory.bond);
    const double back = std::sqrt(back_1 * back_1 + back_2 * back_2);
    point.slips = stiffness * back > strength;
    const double left = point.slips ? strength / back : stiffness;
    point.force.x() = left * back_1;
    point.force.y() = left * back_2;
    point.stiffness(0, 0) = point.stiffness(1, 1) = -left;
    if (!point.slips) return point;
    const double t1 = back_1 / back, t2 = back_2 / back;
    point.stiffness(0, 0) += left * t1 * t1;
    point.stiffness(0, 1) = point.stiffness(1, 0) = left * t1 * t2;
    point.stiffness(1, 1) += left * t2 * t2;
    if (strength <= 0) return point;
    const double slope = contact::strengthSlope(joint, area, normal.force, memory.bond);
    point.stiffness(0, 2) = slope * t1 * point.stiffness(2, 2);
    point.stiffness(1, 2) = slope * t2 * point.stiffness(2, 2);
    return point;
}

/// What a contact point remembers of the step that has led to this response: the plastic slide, as contactLaw has it.
inline void commitSlide(const PointResponse& point, const contact::JointLaw& joint, double area,
                        double slide_1, double slide_2, contact::PointMemory& memory) {
    if (!point.open && !point.slips) return;
    memory.offset_1 = slide_1 + (point.open ? 0.0 : contact::offsetFor(joint, area, point.force.x()));
    memory.offset_2 = slide_2 + (point.open ? 0.0 : contact::offsetFor(joint, area, point.force.y()));
}

}  // namespace talus::equilibrium
