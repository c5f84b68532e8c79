#pragma once
// A joint without tension on a patch that is partly open: pressure k_n (-gap) acts where the gap is negative
// and nowhere else. The gap is affine, so the closed part of a triangle is a triangle or a quadrangle, and
// its integrals are exact. The contact points are those of the rule "vertex" (law/points.h). Each carries the
// pressure of its share of the patch; together they have the resultant and the moments of the pressure.

#include "law/law.h"
#include "law/parameters.h"
#include "simd/scalar.h"

namespace talus::contact {

/// Integrals over the closed part of a triangle of unit area, with each of the three shape functions N_i
/// (linear, 1 at corner i).
struct ClosedPart {
    double by_corner[3] = {0, 0, 0};  ///< S_i = int N_i max(-gap, 0) dA [m]
    /// How S_i grows with the overlap at corner j: int N_i N_j dA. The boundary of the closed part moves, too,
    /// but there the overlap is zero.
    double rate[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    double area[3] = {0, 0, 0};  ///< A_i = int N_i dA
    /// How A_i grows with the overlap at corner j: int N_i N_j / |grad gap| ds over that boundary [1/m].
    double area_rate[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
};

/// Adds a triangle of the closed part, by the values at its three corners.
/// \param shape    [i][v]: shape function i at the piece's corner v
/// \param overlap  at the piece's corners [m]
/// \param area     of the piece, over that of the whole triangle
TALUS_KERNEL void addPiece(const double (&shape)[3][3], const double (&overlap)[3], double area,
                           ClosedPart& sum) {
    // int f g dA of two linear functions over a triangle of area A: A/12 (sum f_v g_v + sum f_v sum g_v).
    const double twelfth = area / 12, all = overlap[0] + overlap[1] + overlap[2];
    double total[3];
    for (int i = 0; i < 3; ++i) {
        total[i] = shape[i][0] + shape[i][1] + shape[i][2];
        sum.area[i] += area / 3 * total[i];
        sum.by_corner[i] += twelfth * (shape[i][0] * overlap[0] + shape[i][1] * overlap[1] +
                                       shape[i][2] * overlap[2] + total[i] * all);
    }
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            sum.rate[i][j] += twelfth * (shape[i][0] * shape[j][0] + shape[i][1] * shape[j][1] +
                                         shape[i][2] * shape[j][2] + total[i] * total[j]);
}

/// Adds the rates of the areas: the line of no overlap cuts off a corner, at shares `s` and `t` of the sides
/// to the next and the last corner. Its length over |grad gap| is 2 s t / |overlap at that corner|, and
/// int f g ds of two linear functions is a sixth of it times 2 f_0 g_0 + 2 f_1 g_1 + f_0 g_1 + f_1 g_0.
TALUS_KERNEL void addBoundary(int tip, double s, double t, double tip_overlap, ClosedPart& sum) {
    constexpr double kNone = 1e-100;  // [m]: the line is at the corner or along the far side, by rounding
    const double depth = tip_overlap < 0 ? -tip_overlap : tip_overlap;
    if (depth < kNone) return;
    const double weight = s * t / (3 * depth);
    double first[3] = {0, 0, 0}, second[3] = {0, 0, 0};
    first[tip] = 1 - s, first[(tip + 1) % 3] = s;
    second[tip] = 1 - t, second[(tip + 2) % 3] = t;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            sum.area_rate[i][j] += weight * (2 * first[i] * first[j] + 2 * second[i] * second[j] +
                                             first[i] * second[j] + second[i] * first[j]);
}

/// The part where an affine overlap is positive. It is not computed as the triangle less the open part: for a
/// narrow strip along a side that leaves only rounding. Toppling blocks stand on such strips.
/// \param overlap  at the corners, negative where the triangle is open [m]
TALUS_KERNEL ClosedPart closedPart(const double (&overlap)[3]) {
    int closed = 0;
    for (const double o : overlap) closed += o > 0 ? 1 : 0;
    ClosedPart part;
    if (closed == 0) return part;
    if (closed == 3) {
        addPiece({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, overlap, 1, part);
        return part;
    }
    // The corner that is not as the other two are; the line of no overlap crosses the sides next to it.
    int tip = 0;
    while ((overlap[tip] > 0) != (closed == 1)) ++tip;
    const int next = (tip + 1) % 3, last = (tip + 2) % 3;
    double shape[3][3] = {};
    if (closed == 1) {
        const double s = overlap[tip] / (overlap[tip] - overlap[next]),
                     t = overlap[tip] / (overlap[tip] - overlap[last]);  // of the sides, from the tip
        shape[tip][0] = 1, shape[tip][1] = 1 - s, shape[tip][2] = 1 - t;
        shape[next][1] = s, shape[last][2] = t;
        addPiece(shape, {overlap[tip], 0, 0}, s * t, part);
        addBoundary(tip, s, t, overlap[tip], part);
        return part;
    }
    const double u = overlap[next] / (overlap[next] - overlap[tip]),
                 w = overlap[last] / (overlap[last] - overlap[tip]);  // of the sides, towards the tip
    shape[next][0] = 1, shape[last][1] = 1;
    shape[last][2] = 1 - w, shape[tip][2] = w;
    addPiece(shape, {overlap[next], overlap[last], 0}, w, part);
    shape[last][1] = 1 - w, shape[tip][1] = w;
    shape[last][2] = 0, shape[next][2] = 1 - u, shape[tip][2] = u;
    addPiece(shape, {overlap[next], 0, 0}, u * (1 - w), part);
    if (overlap[tip] < 0) addBoundary(tip, 1 - u, 1 - w, overlap[tip], part);
    return part;
}

/// Forces of the four contact points of a triangle of the fan, over k_n and the triangle's area: its three
/// corners, then its middle.
struct TriangleShares {
    double overlap[4] = {0, 0, 0, 0};  ///< [m]
    double rate[4][3] = {};            ///< of each by the overlap at the corners
    double closed[4] = {0, 0, 0, 0};   ///< closed area, over the triangle's
    double closed_rate[4][3] = {};     ///< [1/m]
};

/// Closed areas of the points, split as the forces below.
TALUS_KERNEL void shareArea(const ClosedPart& part, int least, TriangleShares& shares) {
    const double(&a)[3] = part.area;
    const double sum = a[0] + a[1] + a[2];
    const bool as_closed = 0.75 * sum <= 3 * a[least];
    shares.closed[3] = as_closed ? 0.75 * sum : 3 * a[least];
    for (int j = 0; j < 3; ++j)
        shares.closed_rate[3][j] =
            as_closed ? 0.75 * (part.area_rate[0][j] + part.area_rate[1][j] + part.area_rate[2][j])
                      : 3 * part.area_rate[least][j];
    for (int i = 0; i < 3; ++i) {
        const bool nothing = !as_closed && i == least;
        shares.closed[i] = nothing ? 0 : simd::larger(a[i] - shares.closed[3] / 3, 0.0);
        for (int j = 0; j < 3; ++j)
            shares.closed_rate[i][j] = nothing ? 0 : part.area_rate[i][j] - shares.closed_rate[3][j] / 3;
    }
}

/// Forces F_i at the corners and F_m at the middle have the triangle's resultant and moments if F_i = S_i -
/// F_m / 3, with any F_m. A closed triangle of the rule "vertex" has F_m = 3/4 sum S_i. No force is negative
/// as long as F_m is at most 3 S_i; where the triangle is partly open that is less. The least S_i belongs to
/// the corner that is most open.
TALUS_KERNEL TriangleShares sharesOf(const double (&overlap)[3]) {
    const ClosedPart part = closedPart(overlap);
    const double(&s)[3] = part.by_corner;
    const double sum = s[0] + s[1] + s[2];
    int least = 0;
    for (int i = 1; i < 3; ++i)
        if (overlap[i] < overlap[least]) least = i;
    const bool as_closed = 0.75 * sum <= 3 * s[least];
    TriangleShares shares;
    shares.overlap[3] = as_closed ? 0.75 * sum : 3 * s[least];
    for (int j = 0; j < 3; ++j)
        shares.rate[3][j] = as_closed ? 0.75 * (part.rate[0][j] + part.rate[1][j] + part.rate[2][j])
                                      : 3 * part.rate[least][j];
    for (int i = 0; i < 3; ++i) {
        shares.overlap[i] = simd::larger(s[i] - shares.overlap[3] / 3, 0.0);
        for (int j = 0; j < 3; ++j) shares.rate[i][j] = part.rate[i][j] - shares.rate[3][j] / 3;
    }
    if (!as_closed) {  // exactly nothing: rounding must not close a point
        shares.overlap[least] = 0;
        for (double& rate : shares.rate[least]) rate = 0;
    }
    shareArea(part, least, shares);
    return shares;
}

/// Weight of the share's pressure against that of the gap at the point, 0..1. It is 0 while the point has a
/// bond that carries tension, which acts where the joint is open, and for dilating joints, whose points open
/// by different amounts.
template <class V>
TALUS_KERNEL V followsShare(const JointParameters<V>& joint, V bond) {
    using simd::select;
    const V one = V{} + 1.0;
    const V unbonded = select(joint.tensile_strength == 0.0, one, select(joint.bonded, one - bond, V{}));
    return select(joint.tan_dilation == 0.0, unbonded, V{});
}

/// The gap that the law takes [m]. A share without pressure that is closed in part keeps its cohesion: its gap
/// is 0.
/// \param overlap  mean over the share; none: the point's own place is open
/// \param closed   closed area over the point's, which corners may exceed
template <class V>
TALUS_KERNEL V gapOfShare(const JointParameters<V>& joint, V bond, V gap, V overlap, V closed) {
    using simd::both, simd::larger, simd::select;
    const auto coheres = both(closed > 0.0, cohesionOf(joint, bond) > 0.0);
    const V shared = select(overlap > 0.0, V{} - overlap, select(coheres, V{}, larger(gap, V{})));
    return gap + followsShare(joint, bond) * (shared - gap);
}

/// Area with cohesion over that of a point. \param closed  as above
template <class V>
TALUS_KERNEL V cohesiveShare(const JointParameters<V>& joint, V bond, V closed) {
    return V{} + 1.0 + followsShare(joint, bond) * (closed - 1.0);
}

}  // namespace talus::contact
