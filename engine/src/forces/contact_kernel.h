#pragma once
// The hot kernel: gap, slide, law and sums for one interface (V = double) or several in a register (V =
// Lanes). One source, a build per instruction set (contact_kernel*.cpp), the same bits.

#include <cstddef>
#include <utility>

#include "forces/contact_group.h"

namespace talus {
namespace {

/// Sum over an interface's contact points: force on b and moment about the interface's origin, in the frame
/// e1, e2, e3.
template <class V>
struct PatchSum {
    Triple<V> force{}, moment{};

    TALUS_KERNEL void add(V xi, V eta, V shear_1, V shear_2, V normal) {
        force.x = force.x + shear_1;
        force.y = force.y + shear_2;
        force.z = force.z + normal;
        moment.x = moment.x + eta * normal;
        moment.y = moment.y - xi * normal;
        moment.z = moment.z + (xi * shear_2 - eta * shear_1);
    }

    /// A shear force acts this far above the plane [m].
    TALUS_KERNEL void raise(V height, V shear_1, V shear_2) {
        moment.x = moment.x - height * shear_2;
        moment.y = moment.y + height * shear_1;
    }
};

/// Velocity of b over a along the normal and the tangents, affine over the patch [m/s].
template <class V>
struct RelativeVelocity {
    Triple<V> normal, tangent_1, tangent_2;
    V by_height_1{}, by_height_2{};  ///< of the tangents' per height over the plane [1/s]
};

template <class V>
TALUS_KERNEL RelativeVelocity<V> relativeVelocity(const RelativePoseOf<V>& pose, const Triple<V>& velocity_a,
                                                  const Triple<V>& spin_a, const Triple<V>& velocity_b,
                                                  const Triple<V>& spin_b) {
    using simd::cross, simd::dot;
    const Triple<V> v = velocity_b + cross(spin_b, pose.arm_b) - velocity_a - cross(spin_a, pose.arm_a);
    const Triple<V> spin = spin_b - spin_a;
    const Triple<V> v_xi = cross(spin, pose.e1), v_eta = cross(spin, pose.e2);
    return {{dot(v, pose.e3), dot(v_xi, pose.e3), dot(v_eta, pose.e3)},
            {dot(v, pose.e1), dot(v_xi, pose.e1), dot(v_eta, pose.e1)},
            {dot(v, pose.e2), dot(v_xi, pose.e2), dot(v_eta, pose.e2)},
            dot(spin, pose.e2),
            V{} - dot(spin, pose.e1)};
}

/// One group's contact points, one after the other. Gap and slides are those of b's material point, which
/// lies pressed below a's plane. With `Arms` the shear force acts there, where its work equals its spring's
/// energy. Else it acts at the point's projection, which is equivalent where no pressed block turns.
template <class V, bool Damped, bool Remembers, bool Curved, bool Arms>
struct PointLoop {
    const ContactView& view;
    const Members<V>& members;
    const RelativePoseOf<V>& pose;
    const contact::JointParameters<V>& law;
    const RelativeVelocity<V>& velocity;
    V release, damping_normal, damping_shear;
    Triple<V> height;  ///< of b's material points over a's plane [m]
    PatchSum<V> sum{};

    /// The viscous term c_k of eqs (3)-(4) beside the spring. It acts while the contact point is closed,
    /// along the surface only while it sticks. It never turns the normal force into tension beyond the
    /// joint's strength.
    TALUS_KERNEL void addDashpot(V xi, V eta, V z, V area, V bond, contact::ForceOf<V>& total) const {
        using simd::either, simd::larger, simd::select;
        const V damped = total.normal - damping_normal * area * affine(velocity.normal, xi, eta);
        const V least = -contact::tensileStrength(law, area, bond);
        total.normal = select(total.open, total.normal, larger(damped, least));
        const V c = select(either(total.open, total.slips), V{}, damping_shear * area);
        V along_1 = affine(velocity.tangent_1, xi, eta), along_2 = affine(velocity.tangent_2, xi, eta);
        if constexpr (Arms) {
            along_1 = along_1 + z * velocity.by_height_1;
            along_2 = along_2 + z * velocity.by_height_2;
        }
        total.shear_1 = total.shear_1 - c * along_1;
        total.shear_2 = total.shear_2 - c * along_2;
    }

    /// Restitution e: a parting contact point has e^2 of its spring's force. An impact then returns e^2 of
    /// the energy that it stored, for any mass, speed, stiffness and shape (O. R. Walton and R. L. Braun,
    /// 1986, put it into the unloading stiffness). Up to kPartingSpeed the loss grows with the speed, so
    /// resting contacts have none. The friction of one that slips falls with the normal force.
    TALUS_KERNEL void unload(V xi, V eta, contact::ForceOf<V>& total) const {
        using simd::larger, simd::select, simd::smaller;
        constexpr double kPartingSpeed = 1e-3;  // [m/s]
        const V parting = larger(affine(velocity.normal, xi, eta), V{}) * (1 / kPartingSpeed);
        const V left = V{} + 1.0 - law.unloading_loss * smaller(parting, V{} + 1.0);
        total.normal = select(total.normal > V{}, left * total.normal, total.normal);
        total.shear_1 = select(total.slips, left * total.shear_1, total.shear_1);
        total.shear_2 = select(total.slips, left * total.shear_2, total.shear_2);
    }

    TALUS_KERNEL void operator()(V xi, V eta, V area, std::size_t slot) {
        update(
            xi, eta, area, slot, [](V gap, V) { return gap; }, [](V) { return V{} + 1.0; });
    }
    TALUS_KERNEL void operator()(V xi, V eta, V area, std::size_t slot, const ShareOf<V>& share) {
        using simd::select;
        update(
            xi, eta, area, slot,
            [&](V gap, V bond) {
                return select(share.counts, contact::gapOfShare(law, bond, gap, share.overlap, share.closed),
                              gap);
            },
            [&](V bond) {
                return select(share.counts, contact::cohesiveShare(law, bond, share.closed), V{} + 1.0);
            });
    }

    /// \param gap_of  what the law takes for the gap at its place and the bond that is left
    /// \param cohesive_of  share of its area that has cohesion, for that bond
    template <class GapOf, class CohesiveOf>
    TALUS_KERNEL void update(V xi, V eta, V area, std::size_t slot, const GapOf& gap_of,
                             const CohesiveOf& cohesive_of) {
        double* row = view.memory + slot * (Remembers ? kMemoryQuantities : kSlideQuantities);
        contact::MemoryOf<V> memory;
        memory.offset_1 = members.load(row);
        memory.offset_2 = members.load(row + kRow);
        if constexpr (Remembers) {
            memory.bond = members.load(row + 2 * kRow);
            memory.dilation = members.load(row + 3 * kRow);
        }
        const V slide_1 = affine(pose.slide_1, xi, eta), slide_2 = affine(pose.slide_2, xi, eta);
        contact::ForceOf<V> force = contact::contactLaw<Remembers, Curved>(
            law, area, gap_of(affine(pose.gap, xi, eta), memory.bond), slide_1, slide_2, release, memory,
            cohesive_of(memory.bond));
        members.store(row, memory.offset_1);
        members.store(row + kRow, memory.offset_2);
        if constexpr (Remembers) {
            members.store(row + 2 * kRow, memory.bond);
            members.store(row + 3 * kRow, memory.dilation);
        }
        if constexpr (Arms) {
            const V z = affine(height, xi, eta);
            if constexpr (Damped) {
                if (view.restitution) unload(xi + slide_1, eta + slide_2, force);
                addDashpot(xi + slide_1, eta + slide_2, z, area, memory.bond, force);
            }
            sum.raise(z, force.shear_1, force.shear_2);
        } else if constexpr (Damped) {
            if (view.restitution) unload(xi, eta, force);
            addDashpot(xi, eta, V{}, area, memory.bond, force);
        }
        sum.add(xi + slide_1, eta + slide_2, force.shear_1, force.shear_2, force.normal);
    }
};

template <class V, PointPlaces Places, bool Damped, bool Remembers, bool Curved, bool Arms>
TALUS_KERNEL void updateMembers(const ContactView& view, std::size_t group_index, const Members<V>& members) {
    const InterfaceGroup& group = view.groups[group_index];
    const FramesOf<V> frames = loadFrames(members, view.frames + group_index * kFrameQuantities * kRow);
    const RelativePoseOf<V> pose =
        relativePoseOf(frames, members.gatherPose(view.position, view.orientation, view.block_a),
                       members.gatherPose(view.position, view.orientation, view.block_b));
    contact::JointParameters<V> law =
        gatherLaw<Curved>(members, view, std::make_index_sequence<contact::kLawParameterCount>{});
    RelativeVelocity<V> velocity;
    V damping_normal{}, damping_shear{};
    if constexpr (Damped) {
        velocity = relativeVelocity(pose, gather(members, view.velocity, view.block_a),
                                    gather(members, view.angular_velocity, view.block_a),
                                    gather(members, view.velocity, view.block_b),
                                    gather(members, view.angular_velocity, view.block_b));
        const contact::StiffnessOf<V> stiffness = contact::stiffnessOf(law);
        if (view.restitution)
            law.unloading_loss =
                members.gather(view.laws, &contact::JointParameters<double>::unloading_loss, view.joint);
        damping_normal = view.contact_damping * stiffness.normal;
        damping_shear = view.contact_damping * stiffness.shear;
    }
    Triple<V> height{};
    if constexpr (Arms) height = pose.gap + frames.reference_gap;
    PointLoop<V, Damped, Remembers, Curved, Arms> points{
        view, members, pose, law, velocity, V{} + view.release, damping_normal, damping_shear, height};
    forEachPoint<Places>(view, group, members, points);
    const PatchSum<V>& sum = points.sum;
    const Triple<V> force = sum.force.x * pose.e1 + sum.force.y * pose.e2 + sum.force.z * pose.e3;
    const Triple<V> moment = sum.moment.x * pose.e1 + sum.moment.y * pose.e2 + sum.moment.z * pose.e3;
    const Triple<V> about_a = simd::cross(pose.arm_a, force) + moment;
    members.storeWrench(view.wrenches + group_index * kWrenchQuantities * kRow, force,
                        {-about_a.x, -about_a.y, -about_a.z}, simd::cross(pose.arm_b, force) + moment);
}

constexpr std::size_t kGroupsAhead = 2;

/// Prefetches `rows` of kLanes doubles, a cache line each.
template <bool Written>
TALUS_KERNEL void fetchRows(const double* row, std::size_t rows) {
    for (; rows > 0; --rows, row += kRow) __builtin_prefetch(row, Written ? 1 : 0);
}

/// Prefetches the data of a group. The processor's own prefetchers fail here, because the streams alternate
/// in short pieces (bench/studies/contact-kernel.md).
template <PointPlaces Places, bool Remembers>
TALUS_KERNEL void fetch(const ContactView& view, std::size_t group_index) {
    constexpr std::size_t memory = Remembers ? kMemoryQuantities : kSlideQuantities;
    const InterfaceGroup& group = view.groups[group_index];
    const auto corners = static_cast<std::size_t>(group.corners),
               first = static_cast<std::size_t>(group.first_corner);
    const auto points = static_cast<std::size_t>(group.points),
               slot = static_cast<std::size_t>(group.first_point);
    fetchRows<false>(view.frames + group_index * kFrameQuantities * kRow, kFrameQuantities);
    if constexpr (Places == PointPlaces::stored)
        fetchRows<false>(view.point_places + slot * kPlaceQuantities, points * kPlaceQuantities);
    else
        fetchRows<false>(view.corners + first * kCornerQuantities, corners * kCornerQuantities);
    fetchRows<true>(view.memory + slot * memory, points * memory);
    fetchRows<true>(view.wrenches + group_index * kWrenchQuantities * kRow, kWrenchQuantities);
}

template <class V, PointPlaces Places, bool Damped, bool Remembers, bool Curved, bool Arms>
void updateGroups(const ContactView& view, std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
        if (view.beyond_caches && g + kGroupsAhead < end && !view.groups[g + kGroupsAhead].is_idle)
            fetch<Places, Remembers>(view, g + kGroupsAhead);
        if (view.groups[g].is_idle) continue;
        for (int lane = 0; lane < view.groups[g].size; lane += Members<V>::kWidth)
            updateMembers<V, Places, Damped, Remembers, Curved, Arms>(view, g,
                                                                      Members<V>(view.groups[g], lane));
    }
}

template <class V, PointPlaces Places, bool Curved, bool Arms>
void updateGroups(const ContactView& view, std::size_t begin, std::size_t end) {
    const bool damped = view.contact_damping > 0 || view.restitution, remembers = view.remembers;
    if (damped && remembers) return updateGroups<V, Places, true, true, Curved, Arms>(view, begin, end);
    if (damped) return updateGroups<V, Places, true, false, Curved, Arms>(view, begin, end);
    if (remembers) return updateGroups<V, Places, false, true, Curved, Arms>(view, begin, end);
    updateGroups<V, Places, false, false, Curved, Arms>(view, begin, end);
}

template <class V, PointPlaces Places>
void updateGroups(const ContactView& view, std::size_t begin, std::size_t end) {
    if (view.curved && view.keeps_energy) return updateGroups<V, Places, true, true>(view, begin, end);
    if (view.curved) return updateGroups<V, Places, true, false>(view, begin, end);
    if (view.keeps_energy) return updateGroups<V, Places, false, true>(view, begin, end);
    updateGroups<V, Places, false, false>(view, begin, end);
}

template <class V>
void updateGroups(const ContactView& view, std::size_t begin, std::size_t end) {
    switch (view.places) {
        case PointPlaces::vertex:
            return updateGroups<V, PointPlaces::vertex>(view, begin, end);
        case PointPlaces::corner:
            return updateGroups<V, PointPlaces::corner>(view, begin, end);
        case PointPlaces::stored:
            return updateGroups<V, PointPlaces::stored>(view, begin, end);
    }
}

}  // namespace
}  // namespace talus
