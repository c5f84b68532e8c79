#pragma once
// The contact law at one Lp (eqs 5-9 of the paper), as pure functions. Every loop calls these; nothing else in the
// engine knows what a joint does.
//
// Signs: gap is positive when open, forces act on the block that is not the reference one; the normal force is the
// effective (spring) force, compression positive. Water acts beside it: eq 7's opening rule with F_n + P is the same
// statement written with the paper's tension-positive total force.

#include <algorithm>
#include <cmath>

namespace talus::contact {

/// A joint's parameters as the kernel wants them.
struct JointLaw {
    double normal_stiffness = 0;       ///< k_n [Pa/m]
    double shear_stiffness = 0;        ///< k_s [Pa/m]
    double tan_friction = 0;           ///< tan(phi), peak
    double cohesion = 0;               ///< C [Pa]
    double tensile_strength = 0;       ///< sigma_t [Pa]
    double residual_tan_friction = 0;  ///< tan(phi_r)
    double residual_cohesion = 0;      ///< C_r [Pa]
    double tan_dilation = 0;           ///< tan(psi)
    bool bonded = false;               ///< C > 0 or sigma_t > 0: opening breaks it for good
};

/// What an Lp remembers. The shear force is -k_s A (slide - offset): a total form of eq 6 in the frame that turns with
/// the reference block, so that nothing drifts however many steps are taken.
struct PointMemory {
    double offset_1 = 0;  ///< slide that is plastic, along the first tangent [m]
    double offset_2 = 0;  ///< along the second tangent [m]
    double bond = 1;      ///< share of the peak strength above the residual that is left: 1 intact, 0 broken
    double dilation = 0;  ///< opening by dilation so far [m]
};

struct PointForce {
    double normal = 0;   ///< F_n, compression positive [N]
    double shear_1 = 0;  ///< F_s along the first tangent [N]
    double shear_2 = 0;  ///< F_s along the second tangent [N]
    bool open = false;
    bool slips = false;
};

/// Largest shear force the Lp carries (right-hand side of the sliding rule, eq 9), zero when open.
inline double shearStrength(const JointLaw& joint, double area, double normal_force, double bond) {
    const double cohesion = joint.residual_cohesion + bond * (joint.cohesion - joint.residual_cohesion);
    const double tan_friction =
        joint.residual_tan_friction + bond * (joint.tan_friction - joint.residual_tan_friction);
    return std::max(0.0, cohesion * area + normal_force * tan_friction);
}

/// Forces at an Lp from its gap and slide; updates its memory.
///
/// `release` is the share of the bond that goes per call once it breaks: 1 in a time history (brittle, eqs 7-9),
/// less in quasi-static work, where a break is let down slowly so that its energy does not break its neighbours.
inline PointForce contactLaw(const JointLaw& joint, double area, double gap, double slide_1, double slide_2,
                             double release, PointMemory& memory) {
    PointForce force;
    // eq 5, total form; the opening rule, eqs 7-8.
    const double trial_normal = -joint.normal_stiffness * area * (gap - memory.dilation);
    double bond = memory.bond;
    const bool torn = joint.bonded && trial_normal < -bond * joint.tensile_strength * area;
    if (torn || bond < 1.0) bond = std::max(0.0, bond - release);
    const double tension_limit = bond * joint.tensile_strength * area;
    force.normal = std::max(trial_normal, -tension_limit);
    force.open = trial_normal < 0.0 && tension_limit == 0.0;
    if (force.open) {
        // Nothing is carried across an open Lp; when it closes again its shear starts from zero.
        memory = {slide_1, slide_2, bond, memory.dilation};
        force.normal = 0.0;
        return force;
    }
    // eq 6, total form; the sliding rule, eq 9: beyond the peak the strength falls to its residual.
    const double elastic_1 = slide_1 - memory.offset_1;
    const double elastic_2 = slide_2 - memory.offset_2;
    const double stiffness = joint.shear_stiffness * area;
    const double trial_squared = stiffness * stiffness * (elastic_1 * elastic_1 + elastic_2 * elastic_2);
    double strength = shearStrength(joint, area, force.normal, bond);
    force.slips = trial_squared > strength * strength;
    double keep = 1.0;
    if (force.slips) {
        if (bond == 1.0) {
            bond = std::max(0.0, bond - release);
            strength = std::min(strength, shearStrength(joint, area, force.normal, bond));
        }
        const double trial = std::sqrt(trial_squared);
        keep = strength / trial;
        memory.offset_1 = slide_1 - keep * elastic_1;
        memory.offset_2 = slide_2 - keep * elastic_2;
        memory.dilation += joint.tan_dilation * (trial - strength) / stiffness;
    }
    memory.bond = bond;
    force.shear_1 = -keep * stiffness * elastic_1;
    force.shear_2 = -keep * stiffness * elastic_2;
    return force;
}

}  // namespace talus::contact
