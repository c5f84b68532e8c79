#pragma once
// The contact law at one contact point (eqs 5-9 of the paper), as pure functions: forces, strength,
// stiffness, energy, and the gap or slide for a force or an energy. Every loop calls these; the behaviour of
// a joint is defined nowhere else. V is a double, or several of them in a register (simd/lanes.h). Both take
// the same steps in the same order and give the same bits.
//
// Signs: gap is positive when open, and forces act on the block that is not the reference one. The normal
// force is the effective (spring) force, compression positive. Water acts beside it: eq 7's opening rule with
// F_n + P is the same statement written with the paper's tension-positive total force.

#include <algorithm>
#include <cmath>

#include "law/parameters.h"
#include "law/strength_curve.h"
#include "simd/scalar.h"

namespace talus::contact {

/// Whether Coulomb's strength is less once it has slipped.
inline bool falls(const JointLaw& joint) {
    return joint.residual_tan_friction != joint.tan_friction || joint.residual_cohesion != joint.cohesion;
}

/// Whether contact points of this joint have to remember more than their plastic slide: strength that is lost
/// for good, dilation.
inline bool hasMemory(const JointLaw& joint) {
    return joint.bonded || (joint.curved ? joint.residual_factor != 1 : falls(joint)) ||
           joint.tan_dilation != 0;
}

/// Whether it loses strength with displacement, not at once.
inline bool softens(const JointLaw& joint) { return joint.softening > 0; }

/// Whether it has strength to lose that `held` can hold.
inline bool isBrittle(const JointLaw& joint) { return !joint.curved && (joint.bonded || falls(joint)); }

/// The same joint with unbreakable bonds: elastic in shear, and in tension where bonded. Broken points keep
/// their residual strength.
inline JointLaw held(JointLaw joint) {
    constexpr double kUnbroken = 1e30;  // [Pa]
    if (!isBrittle(joint)) return joint;
    joint.cohesion = kUnbroken;
    if (joint.bonded) joint.tensile_strength = kUnbroken;
    return joint;
}

/// Whether it opens as it slips.
inline bool dilates(const JointLaw& joint) { return joint.tan_dilation != 0; }

/// What a contact point remembers. The shear force is -k_s A (slide - offset): a total form of eq 6 in the
/// frame that turns with the reference block, free of drift over any number of steps.
template <class V>
struct MemoryOf {
    V offset_1{};        ///< slide that is plastic, along the first tangent [m]
    V offset_2{};        ///< along the second tangent [m]
    V bond = V{} + 1.0;  ///< share of the peak strength above the residual that is left: 1 intact, 0 broken
    V dilation{};        ///< opening by dilation so far [m]
};
using PointMemory = MemoryOf<double>;

template <class V>
struct ForceOf {
    V normal{};   ///< F_n, compression positive [N]
    V shear_1{};  ///< F_s along the first tangent [N]
    V shear_2{};  ///< F_s along the second tangent [N]
    simd::MaskOf<V> open{};
    simd::MaskOf<V> slips{};
};
using PointForce = ForceOf<double>;

/// Stiffness while a contact point neither opens nor slips.
template <class V>
struct StiffnessOf {
    V normal{};  ///< [Pa/m]
    V shear{};   ///< along any tangent [Pa/m]
};
template <class V>
TALUS_KERNEL StiffnessOf<V> stiffnessOf(const JointParameters<V>& joint) {
    return {joint.normal_stiffness, joint.shear_stiffness};
}

/// Largest tension the contact point carries [N].
template <class V>
TALUS_KERNEL V tensileStrength(const JointParameters<V>& joint, V area, V bond) {
    return bond * joint.tensile_strength * area;
}

/// Stiffness in tension, with the remaining bond [Pa/m]. A softening point that has opened beyond its
/// strength unloads along a straight line to closure.
template <class V>
TALUS_KERNEL V tensionStiffness(const JointParameters<V>& joint, V bond) {
    using simd::both, simd::select;
    const V opened = (V{} + 1.0 - bond) * joint.softening;
    const V damaged = joint.normal_stiffness * bond * joint.tensile_strength /
                      (joint.tensile_strength + joint.normal_stiffness * opened);
    return select(both(opened > 0.0, bond > 0.0), damaged, joint.normal_stiffness);
}

/// Remaining share of a softening bond at an opening [m]: 1 up to the opening at its strength, 0 after
/// `softening` more. The strength falls along a straight line (A. Hillerborg, M. Modeer and P.-E. Petersson,
/// Cem. Concr. Res. 6, 1976).
template <class V>
TALUS_KERNEL V bondAtOpening(const JointParameters<V>& joint, V opening, V bond) {
    using simd::larger, simd::smaller;
    const V beyond = opening - joint.tensile_strength / joint.normal_stiffness;
    return smaller(bond, larger(V{} + 1.0 - beyond / joint.softening, V{}));
}

/// The same after a slip beyond its strength [m] (slip weakening: Y. Ida, J. Geophys. Res. 77, 1972).
template <class V>
TALUS_KERNEL V bondAfterSlip(const JointParameters<V>& joint, V slip, V bond) {
    using simd::larger;
    return larger(bond - slip / joint.softening, V{});
}

/// How Coulomb's strength grows with the normal force: between residual and peak by what is left of the bond.
template <class V>
TALUS_KERNEL V coulombSlope(const JointParameters<V>& joint, V bond) {
    return joint.residual_tan_friction + bond * (joint.tan_friction - joint.residual_tan_friction);
}

/// Likewise [Pa]; curves have none.
template <bool Curved = true, class V>
TALUS_KERNEL V cohesionOf(const JointParameters<V>& joint, V bond) {
    const V cohesion = joint.residual_cohesion + bond * (joint.cohesion - joint.residual_cohesion);
    using simd::select;
    if constexpr (Curved) return select(joint.curved, V{}, cohesion);
    return cohesion;
}

/// Coulomb's: the right-hand side of the sliding rule, eq 9.
template <class V>
TALUS_KERNEL V coulombStrength(const JointParameters<V>& joint, V area, V normal_force, V bond) {
    using simd::larger;
    return larger(cohesionOf<false>(joint, bond) * area + normal_force * coulombSlope(joint, bond), V{});
}

/// Share of a curve's strength by what is left of the bond.
template <class V>
TALUS_KERNEL V curveShare(const JointParameters<V>& joint, V bond) {
    return joint.residual_factor + bond * (V{} + 1.0 - joint.residual_factor);
}

/// Largest shear force the contact point carries; by a curve that of its stress. `Curved` may be false when
/// no joint is. \param cohesive  share of its area that has cohesion
template <bool Curved = true, class V>
TALUS_KERNEL V shearStrength(const JointParameters<V>& joint, V area, V normal_force, V bond,
                             V cohesive = V{} + 1.0) {
    using simd::any, simd::larger, simd::select;
    V strength = coulombStrength(joint, cohesive * area, normal_force, bond);
    if constexpr (Curved) {
        if (any(joint.curved)) {
            const V stress = larger(normal_force / area, V{});
            const V on_curve = area * strengthOnCurve(joint.curve, stress) * curveShare(joint, bond);
            strength = select(joint.curved, on_curve, strength);
        }
    }
    return strength;
}

/// Its derivative by the normal force.
template <bool Curved = true, class V>
TALUS_KERNEL V strengthSlope(const JointParameters<V>& joint, V area, V normal_force, V bond) {
    using simd::any, simd::larger, simd::select;
    V slope = coulombSlope(joint, bond);
    if constexpr (Curved) {
        if (any(joint.curved)) {
            const V stress = larger(normal_force / area, V{});
            const V on_curve =
                select(normal_force > 0.0, slopeOfCurve(joint.curve, stress) * curveShare(joint, bond), V{});
            slope = select(joint.curved, on_curve, slope);
        }
    }
    return slope;
}

/// Whether a contact point without tensile strength carries no shear once it is open. A brittle bond in
/// release keeps its share of the cohesion to the end; otherwise forces would jump where the normal force
/// vanishes.
template <class V>
TALUS_KERNEL simd::MaskOf<V> holdsNothing(const JointParameters<V>& joint, V bond) {
    using simd::either;
    return either(!joint.bonded, either(joint.softening > 0.0, bond == 0.0));
}

/// Forces at a contact point from its gap and slide; updates its memory.
///
/// `release` is the share of a broken bond that is removed per call. It is 1 in a time history (brittle, eqs
/// 7-9) and less in quasi-static work, where slow release keeps a break from breaking its neighbours. A
/// softening joint loses its bond with displacement instead: a second call at the same place changes nothing.
/// `Remembers` may be false when no joint `hasMemory`, `Curved` when none is; the result is the same, to the
/// bit.
/// \param cohesive  share of its area that has cohesion
template <bool Remembers = true, bool Curved = true, class V>
TALUS_KERNEL ForceOf<V> contactLaw(const JointParameters<V>& joint, V area, V gap, V slide_1, V slide_2,
                                   V release, MemoryOf<V>& memory, V cohesive = V{} + 1.0) {
    using simd::any, simd::both, simd::either, simd::larger, simd::select, simd::smaller, simd::squareRoot;
    const V zero{};
    ForceOf<V> force;
    // eq 5, total form; the opening rule, eqs 7-8.
    V trial_normal, bond = memory.bond;
    if constexpr (Remembers) {
        trial_normal = -joint.normal_stiffness * area * (gap - memory.dilation);
        const auto softens = joint.softening > 0.0;
        if (any(softens)) {
            const V opening = gap - memory.dilation;
            bond = select(both(softens, joint.bonded), bondAtOpening(joint, opening, bond), bond);
            trial_normal =
                select(opening > 0.0, -tensionStiffness(joint, bond) * area * opening, trial_normal);
        }
        const auto torn = both(joint.bonded, trial_normal < -tensileStrength(joint, area, bond));
        bond = select(both(!softens, either(torn, bond < 1.0)), larger(bond - release, zero), bond);
        const V tension_limit = tensileStrength(joint, area, bond);
        const auto free = both(trial_normal < 0.0, tension_limit == 0.0);
        force.open = both(free, holdsNothing(joint, bond));
        force.normal = select(free, zero, larger(trial_normal, -tension_limit));
    } else {
        trial_normal = -joint.normal_stiffness * area * gap;
        force.open = trial_normal < 0.0;
        force.normal = larger(trial_normal, zero);
    }
    // eq 6, total form; the sliding rule, eq 9: beyond the peak the strength falls to its residual.
    const V back_1 = memory.offset_1 - slide_1, back_2 = memory.offset_2 - slide_2;
    const V stiffness = joint.shear_stiffness * area;
    const V trial_squared = stiffness * stiffness * (back_1 * back_1 + back_2 * back_2);
    V strength, on_curve{};
    if constexpr (Remembers)
        strength = coulombStrength(joint, cohesive * area, force.normal, bond);
    else
        strength = force.normal * joint.tan_friction;
    if constexpr (Curved) {
        if (any(joint.curved)) {
            V opening = gap;
            if constexpr (Remembers) opening = gap - memory.dilation;
            const V stress = larger(-joint.normal_stiffness * opening, zero);
            on_curve = area * strengthOnCurve(joint.curve, stress);
            if constexpr (Remembers)
                strength = select(joint.curved, on_curve * curveShare(joint, bond), strength);
            else
                strength = select(joint.curved, on_curve, strength);
        }
    }
    force.slips = both(!force.open, trial_squared > strength * strength);
    V stiffness_left = stiffness;
    if (any(force.slips)) {
        const V trial = squareRoot(trial_squared);
        if constexpr (Remembers) {
            const auto softens = joint.softening > 0.0;
            auto breaks = both(force.slips, either(softens, bond == 1.0));
            if constexpr (Curved) breaks = both(breaks, either(!joint.curved, joint.residual_factor < 1.0));
            V weaker = larger(bond - release, zero);
            if (any(softens))
                weaker = select(softens, bondAfterSlip(joint, (trial - strength) / stiffness, bond), weaker);
            bond = select(breaks, weaker, bond);
            if (any(softens)) {
                const auto drawn = both(softens, force.normal < 0.0);
                const V limit = tensileStrength(joint, area, bond);
                const V tension =
                    smaller(tensionStiffness(joint, bond) * area * (gap - memory.dilation), limit);
                force.normal = select(drawn, -tension, force.normal);
                force.open = either(force.open, both(drawn, limit == 0.0));
            }
            V left = coulombStrength(joint, cohesive * area, force.normal, bond);
            if constexpr (Curved) left = select(joint.curved, on_curve * curveShare(joint, bond), left);
            strength = select(breaks, smaller(strength, left), strength);
        }
        const V keep = strength / trial;
        stiffness_left = select(force.slips, keep * stiffness, stiffness);
        memory.offset_1 = select(force.slips, slide_1 + keep * back_1, memory.offset_1);
        memory.offset_2 = select(force.slips, slide_2 + keep * back_2, memory.offset_2);
        if constexpr (Remembers)
            memory.dilation =
                select(force.slips, memory.dilation + joint.tan_dilation * (trial - strength) / stiffness,
                       memory.dilation);
    }
    // Nothing is carried across an open contact point; when it closes again its shear starts from zero.
    memory.offset_1 = select(force.open, slide_1, memory.offset_1);
    memory.offset_2 = select(force.open, slide_2, memory.offset_2);
    if constexpr (Remembers) memory.bond = bond;
    force.shear_1 = select(force.open, zero, stiffness_left * back_1);
    force.shear_2 = select(force.open, zero, stiffness_left * back_2);
    return force;
}

// The inverses, for the transfer of contact forces. Springs are linear while a contact point is closed and
// sticks.

/// Overlap at which a contact point carries a normal force [m].
inline double overlapFor(const JointLaw& joint, double area, double normal_force) {
    return normal_force / (joint.normal_stiffness * area);
}

/// Plastic slide, beyond the slide itself, at which it carries a shear force along a tangent [m].
inline double offsetFor(const JointLaw& joint, double area, double shear_force) {
    return shear_force / (joint.shear_stiffness * area);
}

/// Energy of its normal spring [J].
inline double normalEnergy(const JointLaw& joint, double area, double normal_force) {
    return 0.5 * normal_force * normal_force / (joint.normal_stiffness * area);
}

/// Energy of all its springs [J], with what is left of its bond.
inline double storedEnergy(const JointLaw& joint, double area, double bond, const PointForce& force) {
    const double shear = force.shear_1 * force.shear_1 + force.shear_2 * force.shear_2;
    const double normal = force.normal < 0 ? tensionStiffness(joint, bond) : joint.normal_stiffness;
    return 0.5 / area * (force.normal * force.normal / normal + shear / joint.shear_stiffness);
}

/// Energy that presses an overlap deeper by `further` [J].
inline double energyToPress(const JointLaw& joint, double area, double overlap, double further) {
    return joint.normal_stiffness * area * further * (overlap + 0.5 * further);
}

/// How much deeper an overlap is pressed with an energy [m]: the inverse of energyToPress.
inline double pressedBy(const JointLaw& joint, double area, double overlap, double energy) {
    return std::sqrt(overlap * overlap + 2.0 * energy / (joint.normal_stiffness * area)) - overlap;
}

/// The larger of its stiffnesses, for bounds [Pa/m].
inline double largestStiffness(const JointLaw& joint) {
    return std::max(joint.normal_stiffness, joint.shear_stiffness);
}

/// The straight envelope of its strength for limit analysis, the larger of peak and residual: |tau| <=
/// cohesion + sigma_n tan_friction, and tension of at most tensile_strength [Pa].
struct StrengthLine {
    double tan_friction, cohesion, tensile_strength;
};
inline StrengthLine strengthLine(const JointLaw& joint) {
    return {std::max(joint.tan_friction, joint.residual_tan_friction),
            std::max(joint.cohesion, joint.residual_cohesion), joint.tensile_strength};
}

/// Whether it has strength without normal force.
inline bool holdsUnloaded(const JointLaw& joint) {
    const StrengthLine line = strengthLine(joint);
    return line.cohesion > 0 || line.tensile_strength > 0;
}

}  // namespace talus::contact
