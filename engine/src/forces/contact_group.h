#pragma once
// Input of kernels over interfaces, by group: frames, poses, laws, and the contact points in turn, for one
// interface (V = double) or several in a register (V = Lanes, contact_members.h).

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "forces/contact_view.h"
#include "forces/relative_pose.h"
#include "law/closed_part.h"
#include "law/law.h"
#include "state/slot_sizes.h"

namespace talus {
namespace {

using simd::Triple;

/// The members of a group that one register takes: as many as it has room for, or one for V = double.
template <class V>
struct Members;

template <>
struct Members<double> {
    static constexpr int kWidth = 1;
    std::size_t interface;
    std::size_t lane;  ///< place in the group

    TALUS_KERNEL Members(const InterfaceGroup& group, int lane_)
        : interface(static_cast<std::size_t>(group.begin + lane_)), lane(static_cast<std::size_t>(lane_)) {}
    /// One quantity of consecutive slots, the first of the group at `row`.
    TALUS_KERNEL double load(const double* row) const { return row[lane]; }
    TALUS_KERNEL void store(double* row, double v) const { row[lane] = v; }
    /// Into the records of the group's interfaces, the first of them at `to`.
    TALUS_KERNEL void storeWrench(double* to, const Triple<double>& force, const Triple<double>& moment_a,
                                  const Triple<double>& moment_b) const {
        to += kWrenchQuantities * lane;
        to[0] = force.x, to[1] = force.y, to[2] = force.z;
        to[3] = moment_a.x, to[4] = moment_a.y, to[5] = moment_a.z;
        to[6] = moment_b.x, to[7] = moment_b.y, to[8] = moment_b.z;
    }
    /// Four numbers of each into records `stride` doubles apart, the first of the group's at `to`.
    TALUS_KERNEL void storeFour(double* to, std::ptrdiff_t stride, const double* four) const {
        to += stride * static_cast<std::ptrdiff_t>(lane);
        for (int k = 0; k < 4; ++k) to[k] = four[k];
    }
    /// By interface.
    TALUS_KERNEL double take(const double* values) const { return values[interface]; }
    /// values[index[interface]]
    TALUS_KERNEL double gather(const double* values, const std::int32_t* index) const {
        return values[index[interface]];
    }
    TALUS_KERNEL double gather(const contact::JointLaw* laws, double contact::JointParameters<double>::*field,
                               const std::int32_t* index) const {
        return laws[index[interface]].*field;
    }
    TALUS_KERNEL bool gatherFlag(const contact::JointLaw* laws, bool contact::JointParameters<double>::*flag,
                                 const std::int32_t* index) const {
        return laws[index[interface]].*flag;
    }
    TALUS_KERNEL simd::TablesOf<double> gatherCurve(const contact::JointLaw* laws,
                                                    const std::int32_t* index) const {
        return laws[index[interface]].curve;
    }
    TALUS_KERNEL PoseOf<double> gatherPose(const double* position, const double* orientation,
                                           const std::int32_t* block) const {
        const double* x = position + 4 * static_cast<std::ptrdiff_t>(block[interface]);
        const double* q = orientation + 4 * static_cast<std::ptrdiff_t>(block[interface]);
        return {{x[0], x[1], x[2]}, simd::rotationOf(q[0], q[1], q[2], q[3])};
    }
};

constexpr auto kRow = static_cast<std::size_t>(simd::kLanes);  // doubles from one quantity to the next

template <class V>
TALUS_KERNEL Triple<V> loadTriple(const Members<V>& members, const double* row) {
    return {members.load(row), members.load(row + kRow), members.load(row + 2 * kRow)};
}
template <class V>
TALUS_KERNEL Triple<V> gather(const Members<V>& members, const ConstVectors& from,
                              const std::int32_t* index) {
    return {members.gather(from.x, index), members.gather(from.y, index), members.gather(from.z, index)};
}

/// In the order of kFrameVectors (state/interface_frame.h).
template <class V>
TALUS_KERNEL FramesOf<V> loadFrames(const Members<V>& members, const double* row) {
    return {loadTriple(members, row),
            loadTriple(members, row + 3 * kRow),
            loadTriple(members, row + 6 * kRow),
            loadTriple(members, row + 9 * kRow),
            loadTriple(members, row + 12 * kRow),
            loadTriple(members, row + 15 * kRow),
            loadTriple(members, row + 18 * kRow)};
}

/// In the order of contact::kLawParameters; unused ones are not loaded.
/// \param view ContactView, or another with these arrays by the same names
template <bool Curved, class V, class View, std::size_t... P>
TALUS_KERNEL contact::JointParameters<V> gatherLaw(const Members<V>& members, const View& view,
                                                   std::index_sequence<P...>) {
    contact::JointParameters<V> law;
    ((law.*contact::kLawParameters<V>[P].value =
          members.gather(view.laws, contact::kLawParameters<double>[P].value, view.joint)),
     ...);
    using Parameters = contact::JointParameters<double>;
    law.bonded = members.gatherFlag(view.laws, &Parameters::bonded, view.joint);
    if constexpr (Curved) {
        law.curved = members.gatherFlag(view.laws, &Parameters::curved, view.joint);
        law.residual_factor = members.gather(view.laws, &Parameters::residual_factor, view.joint);
        law.curve = members.gatherCurve(view.laws, view.joint);
    }
    return law;
}

/// The same for several lanes, one by one: few patches of a model are partly open.
template <class V>
struct TriangleSharesOf {
    V overlap[4]{}, closed[4]{};
    V rate[4][3]{}, closed_rate[4][3]{};
};
template <class V>
TALUS_KERNEL TriangleSharesOf<V> sharesOf(const V (&overlap)[3]) {
    constexpr std::size_t kCount = sizeof(V) / sizeof(double);
    double given[3][kCount], found[4][kCount], rate[4][3][kCount];
    double closed[4][kCount], closed_rate[4][3][kCount];
    std::memcpy(given, overlap, sizeof given);
    for (std::size_t l = 0; l < kCount; ++l) {
        const contact::TriangleShares shares = contact::sharesOf({given[0][l], given[1][l], given[2][l]});
        for (int i = 0; i < 4; ++i) {
            found[i][l] = shares.overlap[i];
            closed[i][l] = shares.closed[i];
            for (int j = 0; j < 3; ++j) {
                rate[i][j][l] = shares.rate[i][j];
                closed_rate[i][j][l] = shares.closed_rate[i][j];
            }
        }
    }
    TriangleSharesOf<V> result;
    std::memcpy(result.overlap, found, sizeof found);
    std::memcpy(result.rate, rate, sizeof rate);
    std::memcpy(result.closed, closed, sizeof closed);
    std::memcpy(result.closed_rate, closed_rate, sizeof closed_rate);
    return result;
}

/// Share of the rule "distributed" for a contact point of a partly open patch.
template <class V>
struct ShareOf {
    simd::MaskOf<V> counts{};  ///< whether the patch is partly open; else the point has the gap at its place
    V overlap{};               ///< mean over its share [m]
    V closed{};                ///< closed area over the point's; corners may exceed 1
    /// How they grow with the overlap, which is affine over the patch, at its origin and with its slopes [1,
    /// m, m], and over 1 m.
    Triple<V> by_overlap{}, closed_by_overlap{};

    TALUS_KERNEL static void add(V weight, const V (&rate)[3], const V (&xi)[3], const V (&eta)[3],
                                 Triple<V>& by) {
        by.x = by.x + weight * (rate[0] + rate[1] + rate[2]);
        by.y = by.y + weight * (rate[0] * xi[0] + rate[1] * xi[1] + rate[2] * xi[2]);
        by.z = by.z + weight * (rate[0] * eta[0] + rate[1] * eta[1] + rate[2] * eta[2]);
    }
    /// From a sum over triangles with twice their area as weight; what has no area has no share.
    TALUS_KERNEL void divideBy(V twice_area) {
        using simd::select;
        const V inverse = select(twice_area > 0.0, (V{} + 1.0) / twice_area, V{});
        overlap = inverse * overlap;
        closed = inverse * closed;
        by_overlap = inverse * by_overlap;
        closed_by_overlap = inverse * closed_by_overlap;
    }
};

/// Calls each(xi, eta, area, slot, share) for every contact point of a patch that some lane has partly open:
/// places, areas and order are those of the rule "vertex".
template <class View, class V, class Each>
TALUS_KERNEL void forEachShare(const View& view, const InterfaceGroup& group, const Members<V>& members,
                               simd::MaskOf<V> counts, Each& each) {
    const auto twice = [](V ax, V ay, V bx, V by) { return ax * by - ay * bx; };
    const auto corners = static_cast<std::size_t>(group.corners);
    const auto first = static_cast<std::size_t>(group.first_point);
    constexpr std::size_t step = kCornerQuantities * kRow;
    const double* patch_xi = view.corners + static_cast<std::size_t>(group.first_corner) * kCornerQuantities;
    const double* patch_eta = patch_xi + kRow;
    /// A triangle of the fan: two corners of the patch and its centroid.
    struct Triangle {
        V twice_area;
        TriangleSharesOf<V> shares;
        V xi[3], eta[3];
    };
    const auto triangleAt = [&](std::size_t k) {
        const std::size_t here = k * step, next = (k + 1 == corners ? 0 : k + 1) * step;
        const V xi = members.load(patch_xi + here), eta = members.load(patch_eta + here);
        const V next_xi = members.load(patch_xi + next), next_eta = members.load(patch_eta + next);
        const Triple<V>& gap = each.pose.gap;
        const V overlap[3]{-affine(gap, xi, eta), -affine(gap, next_xi, next_eta), -gap.x};
        return Triangle{twice(xi, eta, next_xi, next_eta),
                        sharesOf<V>(overlap),
                        {xi, next_xi, V{}},
                        {eta, next_eta, V{}}};
    };
    const auto addTo = [](ShareOf<V>& share, const Triangle& of, int point) {
        share.overlap = share.overlap + of.twice_area * of.shares.overlap[point];
        share.closed = share.closed + of.twice_area * of.shares.closed[point];
        share.add(of.twice_area, of.shares.rate[point], of.xi, of.eta, share.by_overlap);
        share.add(of.twice_area, of.shares.closed_rate[point], of.xi, of.eta, share.closed_by_overlap);
    };
    ShareOf<V> centroid{counts};
    V whole{};
    Triangle before = triangleAt(corners - 1), now = before;
    for (std::size_t item = 0; item <= 2 * corners; ++item) {
        const std::size_t k = item / 2;
        V xi{}, eta{}, area{};
        std::size_t slot = 0;
        ShareOf<V> share{counts};
        if (k == corners) {
            area = (1.0 / 24) * whole;
            slot = first + corners * kRow;
            share = centroid;
            share.divideBy((1.0 / 12) * whole);
        } else if (item % 2 == 0) {
            now = triangleAt(k);
            xi = now.xi[0], eta = now.eta[0];
            area = (1.0 / 24) * (before.twice_area + now.twice_area);
            slot = first + k * kRow;
            addTo(share, before, 1);
            addTo(share, now, 0);
            share.divideBy((1.0 / 12) * (before.twice_area + now.twice_area));
        } else {
            xi = (1.0 / 3) * (now.xi[0] + now.xi[1]), eta = (1.0 / 3) * (now.eta[0] + now.eta[1]);
            area = 0.375 * now.twice_area;
            slot = first + (corners + 1 + k) * kRow;
            addTo(share, now, 3);
            share.divideBy(0.75 * now.twice_area);
            addTo(centroid, now, 2);
            whole = whole + now.twice_area;
            before = now;
        }
        each(xi, eta, area, slot, share);
    }
}

/// Lanes whose patch is closed in one part and open in another.
template <class View, class V>
TALUS_KERNEL simd::MaskOf<V> partlyOpen(const View& view, const InterfaceGroup& group,
                                        const Members<V>& members, const Triple<V>& gap) {
    using simd::both, simd::larger, simd::smaller;
    constexpr std::size_t step = kCornerQuantities * kRow;
    const double* row = view.corners + static_cast<std::size_t>(group.first_corner) * kCornerQuantities;
    V least = affine(gap, members.load(row), members.load(row + kRow)), most = least;
    for (std::int32_t k = 1; k < group.corners; ++k) {
        row += step;
        const V here = affine(gap, members.load(row), members.load(row + kRow));
        least = smaller(least, here), most = larger(most, here);
    }
    return both(least<0.0, most> 0.0);
}

/// Calls each(xi, eta, area, slot) for every contact point, in the order of contact::patchPoints. The origin
/// is the patch's centroid, so that of the fan triangles follows from two corners.
template <PointPlaces Places, class View, class V, class Each>
TALUS_KERNEL void forEachPoint(const View& view, const InterfaceGroup& group, const Members<V>& members,
                               Each& each) {
    const auto first = static_cast<std::size_t>(group.first_point);
    if constexpr (Places == PointPlaces::stored) {
        for (std::size_t k = 0, slot = first; k < static_cast<std::size_t>(group.points); ++k, slot += kRow) {
            const double* row = view.point_places + slot * kPlaceQuantities;
            each(members.load(row), members.load(row + kRow), members.load(row + 2 * kRow), slot);
        }
    } else {
        const auto corners = static_cast<std::size_t>(group.corners);
        constexpr std::size_t step = kCornerQuantities * kRow;
        const double* patch_xi =
            view.corners + static_cast<std::size_t>(group.first_corner) * kCornerQuantities;
        const double* patch_eta = patch_xi + kRow;
        if (Places == PointPlaces::corner || corners == 1) {
            const V share = members.take(view.patch_area) * (1.0 / static_cast<double>(corners));
            for (std::size_t k = 0; k < corners; ++k)
                each(members.load(patch_xi + k * step), members.load(patch_eta + k * step), share,
                     first + k * kRow);
        } else {
            if (view.distributed) {
                const simd::MaskOf<V> partly_open = partlyOpen(view, group, members, each.pose.gap);
                using simd::any;
                if (any(partly_open)) return forEachShare(view, group, members, partly_open, each);
            }
            // Twice the areas of the fan's triangles.
            const auto twice = [](V ax, V ay, V bx, V by) { return ax * by - ay * bx; };
            const std::size_t last = (corners - 1) * step;
            const V first_xi = members.load(patch_xi), first_eta = members.load(patch_eta);
            V xi = first_xi, eta = first_eta;
            V before = twice(members.load(patch_xi + last), members.load(patch_eta + last), xi, eta);
            V whole{};
            for (std::size_t k = 0; k < corners; ++k) {
                const bool closes = k + 1 == corners;
                const V next_xi = closes ? first_xi : members.load(patch_xi + (k + 1) * step);
                const V next_eta = closes ? first_eta : members.load(patch_eta + (k + 1) * step);
                const V triangle = twice(xi, eta, next_xi, next_eta);
                each(xi, eta, (1.0 / 24) * (before + triangle), first + k * kRow);
                each((1.0 / 3) * (xi + next_xi), (1.0 / 3) * (eta + next_eta), 0.375 * triangle,
                     first + (corners + 1 + k) * kRow);
                whole = whole + triangle;
                before = triangle;
                xi = next_xi;
                eta = next_eta;
            }
            each(V{}, V{}, (1.0 / 24) * whole, first + corners * kRow);
        }
    }
}

}  // namespace
}  // namespace talus
