#include "flow/pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace talus::flow {
namespace {

/// One side of a box.
struct Side {
    Eigen::Index axis = 0;
    double sign = 1;   ///< 1: the box lies below the limit
    double limit = 0;  ///< [m]

    double outside(const Vec3& x) const { return sign * (x[axis] - limit); }
};

std::vector<Side> sidesOf(const FlowBoundary& boundary, const Vec3& origin) {
    std::vector<Side> sides;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        if (std::isfinite(boundary.box_min[axis]))
            sides.push_back({axis, -1, boundary.box_min[axis] - origin[axis]});
        if (std::isfinite(boundary.box_max[axis]))
            sides.push_back({axis, 1, boundary.box_max[axis] - origin[axis]});
    }
    return sides;
}

Vec3 crossing(const Vec3& a, const Vec3& b, const Side& side) {
    const double of_a = side.outside(a), of_b = side.outside(b);
    Vec3 x = a + of_a / (of_a - of_b) * (b - a);
    x[side.axis] = side.limit;
    return x;
}

/// A polygon on either side of a plane. Corners as near to the plane as `same` lie on it.
struct Halves {
    Ring inside, outside;
    bool is_inside = false, is_outside = false;  ///< whether there is an area there
};

Halves halvesOf(const Ring& polygon, const Side& side, double same) {
    Halves halves;
    const auto sideOf = [&](const Vec3& x) {
        const double off = side.outside(x);
        return std::abs(off) <= same ? 0 : (off > 0 ? 1 : -1);
    };
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec3 &x = polygon[k], &next = polygon[(k + 1) % polygon.size()];
        const int here = sideOf(x);
        if (here <= 0) halves.inside.push_back(x);
        if (here >= 0) halves.outside.push_back(x);
        halves.is_inside |= here < 0;
        halves.is_outside |= here > 0;
        if (here * sideOf(next) >= 0) continue;
        halves.inside.push_back(crossing(x, next, side));
        halves.outside.push_back(halves.inside.back());
    }
    return halves;
}

/// What the box leaves of a polygon; without corners where it does not meet it, even in a point.
Ring within(Ring polygon, const std::vector<Side>& sides, double same) {
    for (const Side& side : sides) polygon = halvesOf(polygon, side, same).inside;
    return polygon;
}

/// What lies outside each side of the box in turn, and the rest.
void cut(const Ring& polygon, const std::vector<Side>& sides, double same, std::vector<Ring>& to) {
    Ring rest = polygon;
    for (const Side& side : sides) {
        Halves halves = halvesOf(rest, side, same);
        if (!halves.is_outside) continue;
        to.push_back(std::move(halves.outside));
        if (!halves.is_inside) return;
        rest = std::move(halves.inside);
    }
    to.push_back(std::move(rest));
}

bool isOnEdge(const Vec3& x, const Ring& polygon, double same) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec3 &a = polygon[k], along = polygon[(k + 1) % polygon.size()] - a;
        const Vec3 off = x - a;
        if (off.cross(along).norm() <= same * along.norm()) return true;
    }
    return false;
}

}  // namespace

bool isOfJoint(const FlowBoundary& boundary, std::int32_t joint) {
    return boundary.joints.empty() || std::ranges::find(boundary.joints, joint) != boundary.joints.end();
}

std::vector<Ring> piecesOf(const Ring& polygon, std::int32_t joint, std::span<const FlowBoundary> boundaries,
                           const Vec3& origin, double same) {
    std::vector<Ring> pieces{polygon};
    for (const FlowBoundary& boundary : boundaries) {
        const std::vector<Side> sides = sidesOf(boundary, origin);
        if (!isOfJoint(boundary, joint) || within(polygon, sides, same).empty()) continue;
        std::vector<Ring> next;
        for (const Ring& piece : pieces) cut(piece, sides, same, next);
        pieces = std::move(next);
    }
    return pieces;
}

std::vector<OutlineCorner> cornersInside(const Ring& polygon, std::int32_t joint,
                                         std::span<const FlowBoundary> boundaries, const Vec3& origin,
                                         double same) {
    std::vector<OutlineCorner> corners;
    for (const FlowBoundary& boundary : boundaries) {
        if (boundary.face || !isOfJoint(boundary, joint)) continue;
        const Ring outline = within(polygon, sidesOf(boundary, origin), same);
        const std::size_t count = outline.size();
        for (std::size_t k = 0; count > 2 && k < count; ++k) {
            const Vec3& x = outline[k];
            const double side = std::min((outline[(k + 1) % count] - x).norm(),
                                         (outline[(k + count - 1) % count] - x).norm());
            if (side > same && !isOnEdge(x, polygon, same)) corners.push_back({x, side});
        }
    }
    return corners;
}

Vec3 centroidOf(const Ring& polygon) {
    Vec3 normal = Vec3::Zero();
    const auto across = [&](std::size_t k) {
        return (polygon[k] - polygon[0]).cross(polygon[k + 1] - polygon[0]);
    };
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) normal += across(k);
    normal.normalize();
    double area = 0;
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
        const double part = across(k).dot(normal);
        area += part;
        sum += part / 3 * (polygon[k] + polygon[k + 1] - 2 * polygon[0]);
    }
    return polygon[0] + sum / area;
}

}  // namespace talus::flow
