#pragma once
// The contact law at one contact point with its derivative, for Newton's method: the forces of law/law.h at a
// trial pose, without any commit, and their change with the pose. V is a double, or several of them in a
// register.

#include "law/law.h"

namespace talus::equilibrium {

/// Forces at a contact point on b and their derivatives by the displacement of b's side against a's, both
/// along e1, e2, e3 (e3: normal, the gap is positive when open). The normal force follows the gap alone.
template <class V>
struct PointResponse {
    V shear_1{}, shear_2{};    ///< [N]
    V normal{};                ///< compression positive [N]
    V by_1_1{}, by_1_2{};      ///< of shear_1 by slide_1, and by slide_2 as of shear_2 by slide_1 [N/m]
    V by_2_2{};                ///< of shear_2 by slide_2
    V by_gap_1{}, by_gap_2{};  ///< of the shear forces by the gap: friction follows the normal force
    V by_gap_n{};              ///< of the normal force by the gap
    /// Of the shear forces by the share of the area that has cohesion [N].
    V by_cohesive_1{}, by_cohesive_2{};
    simd::MaskOf<V> open{}, slips{};
};

/// A contact point slips above this share of the strength's square. Points that slipped in the last committed
/// step are at their strength to rounding. If they counted as sticking, or if rounding decided, each step
/// would first have to find the slipping points again.
inline constexpr double kCorner = 1.0 - 1e-9;

/// The law and its exact derivative at a gap and slide, its memory being that of the last equilibrium. Bonds
/// hold their remaining strength: an overloaded one yields at it, and breaks when the step is committed. The
/// derivative is unsymmetric where the contact point slips: its shear force follows the normal force, not the
/// reverse.
/// \param cohesive  share of its area that has cohesion
template <bool Curved = true, class V>
TALUS_KERNEL PointResponse<V> pointResponse(const contact::JointParameters<V>& joint, V area, V slide_1,
                                            V slide_2, V gap, const contact::MemoryOf<V>& memory,
                                            V cohesive = V{} + 1.0) {
    using simd::any, simd::both, simd::larger, simd::select, simd::squareRoot;
    const V zero{};
    PointResponse<V> point;
    const contact::StiffnessOf<V> sticking = contact::stiffnessOf(joint);
    V normal_stiffness = sticking.normal * area;
    const V stiffness = sticking.shear * area;
    const V tension_limit = contact::tensileStrength(joint, area, memory.bond);
    const V opening = gap - memory.dilation;
    if (any(joint.softening > 0.0))
        normal_stiffness =
            select(opening > 0.0, contact::tensionStiffness(joint, memory.bond) * area, normal_stiffness);
    const V trial_normal = -normal_stiffness * opening;
    const auto free = both(trial_normal < 0.0, tension_limit == 0.0);
    point.open = both(free, contact::holdsNothing(joint, memory.bond));
    point.normal = select(free, zero, larger(trial_normal, -tension_limit));
    point.by_gap_n = select(trial_normal < -tension_limit, zero, zero - normal_stiffness);
    const V back_1 = memory.offset_1 - slide_1, back_2 = memory.offset_2 - slide_2;
    const V back_squared = back_1 * back_1 + back_2 * back_2;
    const V strength = contact::shearStrength<Curved>(joint, area, point.normal, memory.bond, cohesive);
    point.slips = both(!point.open, stiffness * stiffness * back_squared > kCorner * strength * strength);
    V left = stiffness;
    if (any(point.slips)) {
        const V back = squareRoot(back_squared);
        left = select(point.slips, strength / back, stiffness);
        const V along_1 = back_1 / back, along_2 = back_2 / back;
        const V slope = select(strength > 0.0,
                               contact::strengthSlope<Curved>(joint, area, point.normal, memory.bond), zero) *
                        point.by_gap_n;
        point.by_1_1 = select(point.slips, left * along_1 * along_1, zero);
        point.by_1_2 = select(point.slips, left * along_1 * along_2, zero);
        point.by_2_2 = select(point.slips, left * along_2 * along_2, zero);
        point.by_gap_1 = select(point.slips, slope * along_1, zero);
        point.by_gap_2 = select(point.slips, slope * along_2, zero);
        const V cohesion =
            select(strength > 0.0, contact::cohesionOf<Curved>(joint, memory.bond) * area, zero);
        point.by_cohesive_1 = select(point.slips, cohesion * along_1, zero);
        point.by_cohesive_2 = select(point.slips, cohesion * along_2, zero);
    }
    left = select(point.open, zero, left);
    point.by_1_1 = point.by_1_1 - left;
    point.by_2_2 = point.by_2_2 - left;
    point.shear_1 = left * back_1;
    point.shear_2 = left * back_2;
    return point;
}

}  // namespace talus::equilibrium
