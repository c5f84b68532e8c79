#pragma once
// Places of the contact points of a patch, and the share of its area for each.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "talus/model.h"

namespace talus::contact {

struct PatchPoint {
    Eigen::Vector2d position;  ///< in the plane of the patch [m]
    double area;               ///< A_s [m^2]
};

/// Contact points of a convex patch given counter-clockwise. The areas add up to the patch's.
///  - vertex: exact for polynomials of degree 2 (so the closed stiffness is exact), outermost points on the
///    outline
///    (so the overturning pivot of a rigid joint is exact);
///  - distributed: the same points; what they carry while the patch is partly open is in closed_part.h;
///  - quarter: the paper's rule, one sub-area per vertex, its contact point at the sub-area's centroid;
///  - corner: the patch's vertices, equal shares;
///  - grid N: centroids of N x N equal cells on a rectangle; on the other patches of a model in motion,
///    `vertex`.
std::vector<PatchPoint> patchPoints(std::span<const Eigen::Vector2d> patch, const PointRule& rule);

/// How many contact points patchPoints gives. A vertex or edge contact, of one corner, has one.
std::size_t pointCount(std::span<const Eigen::Vector2d> patch, const PointRule& rule);

/// Four right angles, to a relative 1e-9.
bool isRectangle(std::span<const Eigen::Vector2d> patch);

}  // namespace talus::contact
