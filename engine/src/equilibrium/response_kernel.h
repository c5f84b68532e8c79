#pragma once
// Force, moment and their derivative at interfaces, with the law, lever arms and turning frames in it: one
// source, a build per instruction set (response_kernel*.cpp), the same bits.

#include "equilibrium/point_response.h"
#include "equilibrium/response_view.h"
#include "forces/contact_group.h"

namespace talus::equilibrium {
namespace {

/// 3 x 3, by columns.
template <class V>
struct Square {
    Triple<V> c[3];
};

template <class V>
TALUS_KERNEL Square<V> operator-(const Square<V>& a, const Square<V>& b) {
    return {{a.c[0] - b.c[0], a.c[1] - b.c[1], a.c[2] - b.c[2]}};
}
template <class V>
TALUS_KERNEL Square<V> operator+(const Square<V>& a, const Square<V>& b) {
    return {{a.c[0] + b.c[0], a.c[1] + b.c[1], a.c[2] + b.c[2]}};
}

/// [v]x
template <class V>
TALUS_KERNEL Square<V> crossOf(const Triple<V>& v) {
    return {{{V{}, v.z, -v.y}, {-v.z, V{}, v.x}, {v.y, -v.x, V{}}}};
}
/// m [v]x
template <class V>
TALUS_KERNEL Square<V> timesCross(const Square<V>& m, const Triple<V>& v) {
    return {{v.z * m.c[1] - v.y * m.c[2], v.x * m.c[2] - v.z * m.c[0], v.y * m.c[0] - v.x * m.c[1]}};
}
/// [v]x m
template <class V>
TALUS_KERNEL Square<V> crossTimes(const Triple<V>& v, const Square<V>& m) {
    return {{simd::cross(v, m.c[0]), simd::cross(v, m.c[1]), simd::cross(v, m.c[2])}};
}

/// A matrix along e1, e2, e3, in the model frame.
template <class V>
TALUS_KERNEL Square<V> inModel(const RelativePoseOf<V>& pose, const Square<V>& m) {
    Square<V> half;  // E m, E with the axes as columns
    for (int k = 0; k < 3; ++k) half.c[k] = m.c[k].x * pose.e1 + m.c[k].y * pose.e2 + m.c[k].z * pose.e3;
    return {{pose.e1.x * half.c[0] + pose.e2.x * half.c[1] + pose.e3.x * half.c[2],
             pose.e1.y * half.c[0] + pose.e2.y * half.c[1] + pose.e3.y * half.c[2],
             pose.e1.z * half.c[0] + pose.e2.z * half.c[1] + pose.e3.z * half.c[2]}};
}

/// Of a relative motion of b against a, displacement at the interface's origin and turn, both along e1, e2,
/// e3: force and moment about the origin, summed over the contact points, and their derivatives.
template <class V>
struct ResponseSum {
    Triple<V> force{}, moment{};
    Square<V> force_by_shift{}, force_by_turn{}, moment_by_shift{}, moment_by_turn{};
    simd::MaskOf<V> carries{};

    /// The force acts at (x, y), the projection of b's material point onto a's plane.
    TALUS_KERNEL void add(const PointResponse<V>& point, V x, V y) {
        force = force + Triple<V>{point.shear_1, point.shear_2, point.normal};
        moment =
            moment + Triple<V>{y * point.normal, -(x * point.normal), x * point.shear_2 - y * point.shear_1};
        using simd::either;
        carries = either(carries, !point.open);
    }

    /// The material point, at (x, y, z) from the origin, goes with the motion by displacement + turn x it.
    /// \param gap_by  how its gap grows with the displacement along e3 at the origin, and at places: sums of
    /// x and y
    TALUS_KERNEL void addRates(const PointResponse<V>& point, V x, V y, V z, const Triple<V>& gap_by) {
        const V zero{};
        // By its displacement along e1, e2, e3.
        const Triple<V> force_by[3]{{point.by_1_1, point.by_1_2, zero},
                                    {point.by_1_2, point.by_2_2, zero},
                                    {point.by_gap_1, point.by_gap_2, point.by_gap_n}};
        const Triple<V> moment_by[3]{
            {zero, -point.normal, x * point.by_1_2 - y * point.by_1_1 + point.shear_2},
            {point.normal, zero, x * point.by_2_2 - y * point.by_1_2 - point.shear_1},
            {y * point.by_gap_n, -(x * point.by_gap_n), x * point.by_gap_2 - y * point.by_gap_1}};
        addRates(force_by, x, y, z, gap_by, force_by_shift, force_by_turn);
        addRates(moment_by, x, y, z, gap_by, moment_by_shift, moment_by_turn);
    }

    /// What the cohesion of a partly open share adds. \param by  how that share grows: as gap_by above
    TALUS_KERNEL void addCohesiveRates(const PointResponse<V>& point, V x, V y, const Triple<V>& by) {
        const V zero{};
        const Triple<V> force{point.by_cohesive_1, point.by_cohesive_2, zero};
        const Triple<V> torque{zero, zero, x * point.by_cohesive_2 - y * point.by_cohesive_1};
        addNormalRates(force, by, force_by_shift, force_by_turn);
        addNormalRates(torque, by, moment_by_shift, moment_by_turn);
    }

 private:
    TALUS_KERNEL static void addNormalRates(const Triple<V>& rate, const Triple<V>& by, Square<V>& by_shift,
                                            Square<V>& by_turn) {
        by_shift.c[2] = by_shift.c[2] + by.x * rate;
        by_turn.c[0] = by_turn.c[0] + by.z * rate;
        by_turn.c[1] = by_turn.c[1] - by.y * rate;
    }

    TALUS_KERNEL static void addRates(const Triple<V> (&by)[3], V x, V y, V z, const Triple<V>& gap_by,
                                      Square<V>& by_shift, Square<V>& by_turn) {
        by_shift.c[0] = by_shift.c[0] + by[0];
        by_shift.c[1] = by_shift.c[1] + by[1];
        by_shift.c[2] = by_shift.c[2] + gap_by.x * by[2];
        by_turn.c[0] = by_turn.c[0] + (gap_by.z * by[2] - z * by[1]);
        by_turn.c[1] = by_turn.c[1] + (z * by[0] - gap_by.y * by[2]);
        by_turn.c[2] = by_turn.c[2] + (x * by[1] - y * by[0]);
    }
};

/// The derivatives of force and moment about the origin by the displacement and turn of one block (of a:
/// negated).
template <class V>
struct ByBlock {
    Square<V> force_by_shift, force_by_turn, moment_by_shift, moment_by_turn;
};

/// The relative motion at the origin, `arm` from the block's centroid, is shift + turn x arm.
template <class V>
TALUS_KERNEL ByBlock<V> byBlock(const Square<V>& force_by_shift, const Square<V>& force_by_turn,
                                const Square<V>& moment_by_shift, const Square<V>& moment_by_turn,
                                const Triple<V>& arm) {
    return {force_by_shift, force_by_turn - timesCross(force_by_shift, arm), moment_by_shift,
            moment_by_turn - timesCross(moment_by_shift, arm)};
}

/// The two blocks' lever arms and inverse radii.
template <class V>
struct Side {
    Triple<V> arm;  ///< from the centroid to the interface's origin, which goes with a
    V inverse_radius;
};

/// 6 x 6, column by column.
template <class V>
struct StiffnessBlock {
    V number[kStiffnessBlock];

    TALUS_KERNEL void put(int column, const Triple<V>& force, const Triple<V>& moment) {
        V* to = number + 6 * column;
        to[0] = force.x, to[1] = force.y, to[2] = force.z;
        to[3] = moment.x, to[4] = moment.y, to[5] = moment.z;
    }
};

/// Of the wrench on a block by the motion of one. \param moment_by_shift  about the centroid
template <class V>
TALUS_KERNEL StiffnessBlock<V> makeBlock(const Side<V>& wrench, const ByBlock<V>& by, const Side<V>& motion,
                                         const Square<V>& moment_by_shift) {
    StiffnessBlock<V> block;
    const Square<V> moment_by_turn = by.moment_by_turn + crossTimes(wrench.arm, by.force_by_turn);
    const V of_both = wrench.inverse_radius * motion.inverse_radius;
    for (int k = 0; k < 3; ++k) {
        block.put(k, by.force_by_shift.c[k], wrench.inverse_radius * moment_by_shift.c[k]);
        block.put(3 + k, motion.inverse_radius * by.force_by_turn.c[k], of_both * moment_by_turn.c[k]);
    }
    return block;
}

template <class V>
TALUS_KERNEL void storeBlock(const Members<V>& members, const StiffnessBlock<V>& block, double* to) {
    for (std::size_t k = 0; k < kStiffnessBlock; k += 4)
        members.storeFour(to + k, static_cast<std::ptrdiff_t>(kStiffnessQuantities), block.number + k);
}

/// Relative motion is b's less a's, force and moment turn with a's frame, and the origin goes with a.
template <class V>
TALUS_KERNEL void storeStiffness(const Members<V>& members, const RelativePoseOf<V>& pose,
                                 const ResponseSum<V>& sum, const Triple<V>& force, const Triple<V>& moment,
                                 const Side<V>& a, const Side<V>& b, double* to) {
    const Square<V> force_by_shift = inModel(pose, sum.force_by_shift);
    const Square<V> force_by_turn = inModel(pose, sum.force_by_turn);
    const Square<V> moment_by_shift = inModel(pose, sum.moment_by_shift);
    const Square<V> moment_by_turn = inModel(pose, sum.moment_by_turn);
    const ByBlock<V> by_b = byBlock(force_by_shift, force_by_turn, moment_by_shift, moment_by_turn, b.arm);
    ByBlock<V> by_a = byBlock(force_by_shift, force_by_turn, moment_by_shift, moment_by_turn, a.arm);
    const Square<V> f = crossOf(force);
    by_a.force_by_turn = by_a.force_by_turn + f;
    by_a.moment_by_turn = by_a.moment_by_turn + crossOf(moment) - timesCross(f, a.arm);
    const Square<V> on_a = moment_by_shift + crossTimes(a.arm, force_by_shift);
    const Square<V> on_b = moment_by_shift + crossTimes(b.arm, force_by_shift) + f;
    storeBlock(members, makeBlock(a, by_a, a, on_a), to);
    storeBlock(members, makeBlock(a, by_b, b, on_a), to + kStiffnessBlock);
    storeBlock(members, makeBlock(b, by_a, a, on_b), to + 2 * kStiffnessBlock);
    storeBlock(members, makeBlock(b, by_b, b, on_b), to + 3 * kStiffnessBlock);
}

/// What the law takes at a contact point, and how that grows with the motion (ResponseSum::addRates): at the
/// point's own place.
template <class V>
struct AtPlace {
    TALUS_KERNEL V gap(V at_place, V) const { return at_place; }
    TALUS_KERNEL V cohesive(V) const { return V{} + 1.0; }
    TALUS_KERNEL void addRates(const PointResponse<V>& point, V x, V y, V z, V, ResponseSum<V>& sum) const {
        sum.addRates(point, x, y, z, {V{} + 1.0, x, y});
    }
};

/// The same of its share of a patch that is partly open.
template <class V>
struct OverShare {
    const ShareOf<V>& share;
    const RelativePoseOf<V>& pose;
    const contact::JointParameters<V>& law;

    TALUS_KERNEL V gap(V at_place, V bond) const {
        using simd::select;
        return select(share.counts, contact::gapOfShare(law, bond, at_place, share.overlap, share.closed),
                      at_place);
    }
    TALUS_KERNEL V cohesive(V bond) const {
        using simd::select;
        return select(share.counts, contact::cohesiveShare(law, bond, share.closed), V{} + 1.0);
    }
    TALUS_KERNEL void addRates(const PointResponse<V>& point, V x, V y, V z, V bond,
                               ResponseSum<V>& sum) const {
        using simd::select;
        const V one = V{} + 1.0;
        const V follows = select(share.counts, contact::followsShare(law, bond), V{});
        const Triple<V> by = slid(share.by_overlap);
        sum.addRates(point, x, y, z,
                     {one + follows * (by.x - one), x + follows * (by.y - x), y + follows * (by.z - y)});
        sum.addCohesiveRates(point, x, y, -follows * slid(share.closed_by_overlap));
    }

 private:
    /// The material points at which the share's overlap is measured have slid.
    TALUS_KERNEL Triple<V> slid(const Triple<V>& by) const {
        return {by.x, by.y + (by.x * pose.slide_1.x + by.y * pose.slide_1.y + by.z * pose.slide_1.z),
                by.z + (by.x * pose.slide_2.x + by.y * pose.slide_2.y + by.z * pose.slide_2.z)};
    }
};

/// One group's contact points, one after the other.
template <class V, bool Curved, bool Stiffness>
struct ResponseLoop {
    const ResponseView& view;
    const Members<V>& members;
    const RelativePoseOf<V>& pose;
    const contact::JointParameters<V>& law;
    Triple<V> height;  ///< of b's material points over a's plane [m]
    ResponseSum<V> sum{};

    TALUS_KERNEL void operator()(V xi, V eta, V area, std::size_t slot) {
        respond(xi, eta, area, slot, AtPlace<V>{});
    }
    TALUS_KERNEL void operator()(V xi, V eta, V area, std::size_t slot, const ShareOf<V>& share) {
        respond(xi, eta, area, slot, OverShare<V>{share, pose, law});
    }

    /// \param how  AtPlace, or OverShare
    template <class How>
    TALUS_KERNEL void respond(V xi, V eta, V area, std::size_t slot, const How& how) {
        using simd::any;
        const double* row = view.memory + slot * (view.remembers ? kMemoryQuantities : kSlideQuantities);
        contact::MemoryOf<V> memory;
        memory.offset_1 = members.load(row);
        memory.offset_2 = members.load(row + kRow);
        if (view.remembers) {
            memory.bond = members.load(row + 2 * kRow);
            memory.dilation = members.load(row + 3 * kRow);
        }
        const V slide_1 = affine(pose.slide_1, xi, eta), slide_2 = affine(pose.slide_2, xi, eta);
        const PointResponse<V> point = pointResponse<Curved>(law, area, slide_1, slide_2,
                                                             how.gap(affine(pose.gap, xi, eta), memory.bond),
                                                             memory, how.cohesive(memory.bond));
        if (!any(!point.open)) return;
        const V x = xi + slide_1, y = eta + slide_2;
        sum.add(point, x, y);
        if constexpr (Stiffness) how.addRates(point, x, y, affine(height, xi, eta), memory.bond, sum);
    }
};

template <class V, PointPlaces Places, bool Curved, bool Stiffness>
TALUS_KERNEL void respondMembers(const ResponseView& view, std::size_t group_index, double* stiffness,
                                 const Members<V>& members) {
    using simd::any, simd::select;
    const InterfaceGroup& group = view.groups[group_index];
    const FramesOf<V> frames = loadFrames(members, view.frames + group_index * kFrameQuantities * kRow);
    const RelativePoseOf<V> pose =
        relativePoseOf(frames, members.gatherPose(view.position, view.orientation, view.block_a),
                       members.gatherPose(view.position, view.orientation, view.block_b));
    const contact::JointParameters<V> law =
        gatherLaw<Curved>(members, view, std::make_index_sequence<contact::kLawParameterCount>{});
    ResponseLoop<V, Curved, Stiffness> points{view, members, pose, law, pose.gap + frames.reference_gap};
    forEachPoint<Places>(view, group, members, points);
    const ResponseSum<V>& sum = points.sum;
    const Triple<V> force = sum.force.x * pose.e1 + sum.force.y * pose.e2 + sum.force.z * pose.e3;
    const Triple<V> moment = sum.moment.x * pose.e1 + sum.moment.y * pose.e2 + sum.moment.z * pose.e3;
    const Triple<V> about_a = simd::cross(pose.arm_a, force) + moment;
    members.storeWrench(view.wrenches + group_index * kWrenchQuantities * kRow, force,
                        {-about_a.x, -about_a.y, -about_a.z}, simd::cross(pose.arm_b, force) + moment);
    members.store(view.carries + group_index * kRow, select(sum.carries, V{} + 1.0, V{}));
    if constexpr (Stiffness) {
        if (!any(sum.carries)) return;
        storeStiffness(members, pose, sum, force, moment,
                       {pose.arm_a, members.gather(view.inverse_radius, view.block_a)},
                       {pose.arm_b, members.gather(view.inverse_radius, view.block_b)}, stiffness);
    }
}

template <class V, PointPlaces Places, bool Curved, bool Stiffness>
void respondGroups(const ResponseView& view, std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
        if (view.groups[g].is_idle) continue;
        double* stiffness = Stiffness ? view.stiffness + (g - begin) * kRow * kStiffnessQuantities : nullptr;
        for (int lane = 0; lane < view.groups[g].size; lane += Members<V>::kWidth)
            respondMembers<V, Places, Curved, Stiffness>(view, g, stiffness,
                                                         Members<V>(view.groups[g], lane));
    }
}

template <class V, PointPlaces Places>
void respondGroups(const ResponseView& view, std::size_t begin, std::size_t end) {
    const bool stiffness = view.stiffness != nullptr;
    if (view.curved && stiffness) return respondGroups<V, Places, true, true>(view, begin, end);
    if (view.curved) return respondGroups<V, Places, true, false>(view, begin, end);
    if (stiffness) return respondGroups<V, Places, false, true>(view, begin, end);
    respondGroups<V, Places, false, false>(view, begin, end);
}

template <class V>
void respond(const ResponseView& view, std::size_t begin, std::size_t end) {
    switch (view.places) {
        case PointPlaces::vertex:
            return respondGroups<V, PointPlaces::vertex>(view, begin, end);
        case PointPlaces::corner:
            return respondGroups<V, PointPlaces::corner>(view, begin, end);
        case PointPlaces::stored:
            return respondGroups<V, PointPlaces::stored>(view, begin, end);
    }
}

}  // namespace
}  // namespace talus::equilibrium
