#include "flow/footprints.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "flow/places.h"
#include "geometry/box_clip.h"

namespace talus::flow {
namespace {

// bench/studies/drain-in-a-joint.md says how halving and doubling these changes the discharge and the mesh.
constexpr double kOfDistance = 0.5;     // longest side over the distance from the outline, at most
constexpr double kOfWidth = 1.0 / 8;    // longest side on an outline over its width
constexpr double kOfLength = 1.0 / 64;  // the same over its length, where that is more

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Distance to the left of a line [m].
double leftOf(const Vec2& from, const Vec2& to, const Vec2& x) {
    return cross(to - from, x - from) / (to - from).norm();
}

double lengthOf(const Polygon& polygon) {
    double most = 0;
    for (const Vec2& a : polygon)
        for (const Vec2& b : polygon) most = std::max(most, (a - b).norm());
    return most;
}

/// Least distance between two parallel lines that hold the polygon between them [m].
double widthOf(const Polygon& polygon) {
    double least = polygon.empty() ? 0 : kInfinity;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        double across = 0;
        for (const Vec2& x : polygon) across = std::max(across, leftOf(polygon[i], polygon.next(i), x));
        least = std::min(least, across);
    }
    return least;
}

/// Whether a point is inside by more than -margin.
bool isInside(std::span<const Vec2> outline, const Vec2& x, double margin) {
    for (std::size_t i = 0; i < outline.size(); ++i)
        if (leftOf(outline[i], outline[(i + 1) % outline.size()], x) < -margin) return false;
    return true;
}

/// One patch of the network, which is a fan of triangles.
class Fan {
 public:
    Fan(const Network& network, std::size_t first, std::size_t end)
        : patch_(network.patch_of[first]), same_(kNear * network.size) {
        nodes_.push_back(network.corner(first, 0));
        plane_ = faceFrame(nodes_[0], network.corner(first, 1), network.patch(first).normal);
        for (std::size_t t = first; t < end; ++t) {
            nodes_.push_back(network.corner(t, 1));
            outline_.push(plane_.toPlane(nodes_.back()));
        }
    }

    /// Of a boundary without `face`: the part of the polygon in its box, or edges that the box only touches. Nodes
    /// within `same_` of a box count as inside, so a thinner box is widened to that.
    void add(const Vec3& low, const Vec3& high, std::vector<Footprint>& to) const {
        Polygon taken = clippedToBox(outline_, plane_, low, high, same_);
        if (widthOf(taken) <= same_) {
            const Vec3 margin = Vec3::Constant(same_);
            taken = clippedToBox(outline_, plane_, low - margin, high + margin, same_);
        }
        const double width = widthOf(taken);
        if (width <= 1.5 * same_) {
            for (std::size_t i = 1; i < nodes_.size(); ++i)
                addOnEdge(nodes_[i], nodes_[i + 1 < nodes_.size() ? i + 1 : 1], low, high, to);
            return;
        }
        if (isAllIn(low, high)) return;
        double size = kInfinity;
        if (hasCornerInside(taken)) size = std::max(kOfWidth * width, kOfLength * lengthOf(taken));
        to.push_back(footprint({taken.begin(), taken.end()}, size));
    }

    /// Of a boundary of open ends, on this edge.
    void addOnEdge(const Vec3& begin, const Vec3& end, const Vec3& low, const Vec3& high,
                   std::vector<Footprint>& to) const {
        const Vec3 margin = Vec3::Constant(same_), way = end - begin;
        const Stretch stretch = stretchInBox(begin, end, low - margin, high + margin);
        const double before = stretch.from * way.norm(), after = (1 - stretch.to) * way.norm();
        const double length = way.norm() - before - after;
        if (length <= 2 * same_ || (before <= 2 * same_ && after <= 2 * same_)) return;
        to.push_back(
            footprint({plane_.toPlane(begin + stretch.from * way), plane_.toPlane(begin + stretch.to * way)},
                      kOfWidth * length));
    }

 private:
    Footprint footprint(std::vector<Vec2> corners, double size) const {
        Vec2 middle = Vec2::Zero();
        for (const Vec2& corner : corners) middle += corner / static_cast<double>(corners.size());
        double reach = 0;
        for (const Vec2& corner : corners) reach = std::max(reach, (corner - middle).norm());
        return {patch_, plane_, std::move(corners), size, same_, plane_.toWorld(middle), reach};
    }

    bool hasCornerInside(const Polygon& taken) const {
        return std::any_of(taken.begin(), taken.end(), [&](const Vec2& corner) {
            return isInside({outline_.begin(), outline_.end()}, corner, -same_);
        });
    }

    bool isAllIn(const Vec3& low, const Vec3& high) const {
        return std::all_of(nodes_.begin(), nodes_.end(),
                           [&](const Vec3& x) { return isInBox(x, low, high, same_); });
    }

    std::int32_t patch_;
    double same_;              ///< [m]
    std::vector<Vec3> nodes_;  ///< the centre, then the corners
    FaceFrame plane_;
    Polygon outline_;
};

std::vector<Fan> fansOf(const Network& network) {
    std::vector<Fan> fans;
    for (std::size_t t = 0, next = 0; t < network.triangles.size(); t = next) {
        while (next < network.triangles.size() && network.patch_of[next] == network.patch_of[t]) ++next;
        fans.emplace_back(network, t, next);
    }
    return fans;
}

double distanceToSide(const Vec2& x, const Vec2& from, const Vec2& to) {
    const Vec2 along = to - from;
    const double place = std::clamp((x - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (from + place * along - x).norm();
}

/// Least distance of a corner of `of` from a side of `others` [m].
double distanceOfCorners(std::span<const Vec2> of, std::span<const Vec2> others) {
    double least = kInfinity;
    for (const Vec2& x : of)
        for (std::size_t i = 0; i < others.size(); ++i)
            least = std::min(least, distanceToSide(x, others[i], others[(i + 1) % others.size()]));
    return least;
}

/// Whether a line through one of the sides of `of` has all of `others` beyond it.
bool isParted(std::span<const Vec2> of, std::span<const Vec2> others) {
    for (std::size_t i = 0; i < of.size(); ++i) {
        const Vec2 &from = of[i], &to = of[(i + 1) % of.size()];
        if (std::all_of(others.begin(), others.end(), [&](const Vec2& x) { return leftOf(from, to, x) < 0; }))
            return true;
    }
    return false;
}

}  // namespace

std::vector<Footprint> footprintsOf(const Network& network, std::span<const FlowBoundary> boundaries,
                                    const Vec3& origin) {
    std::vector<Footprint> footprints;
    const std::vector<Fan> fans = fansOf(network);
    const std::vector<OpenEdge> edges = openEdges(network);
    const auto node = [&](std::int32_t n) -> const Vec3& {
        return network.nodes[static_cast<std::size_t>(n)];
    };
    for (const FlowBoundary& boundary : boundaries) {
        const Vec3 low = boundary.box_min - origin, high = boundary.box_max - origin;
        if (!boundary.face) {
            for (std::size_t p = 0; p < fans.size(); ++p)
                if (takesJoint(boundary, network.patches[p].joint)) fans[p].add(low, high, footprints);
            continue;
        }
        for (const OpenEdge& edge : edges)
            if (takesJoint(boundary, network.patch(edge.triangle).joint) && takesFace(boundary, edge.outward))
                fans[static_cast<std::size_t>(network.patch_of[edge.triangle])].addOnEdge(
                    node(edge.nodes[0]), node(edge.nodes[1]), low, high, footprints);
    }
    return footprints;
}

bool isTooLarge(const Footprint& footprint, const std::array<Vec3, 3>& triangle) {
    double side = 0, far = 0;
    const Vec3 middle = (triangle[0] + triangle[1] + triangle[2]) / 3;
    for (std::size_t k = 0; k < 3; ++k) {
        side = std::max(side, (triangle[k] - triangle[(k + 1) % 3]).norm());
        far = std::max(far, (triangle[k] - middle).norm());
    }
    const double least = (middle - footprint.centre).norm() - far - footprint.reach;  // quick
    if (side <= std::max(footprint.size, kOfDistance * least)) return false;
    const std::span<const Vec2> outline = footprint.corners;
    std::array<Vec2, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = footprint.plane.toPlane(triangle[k]);
    const auto isTaken = [&](const Vec2& x) { return isInside(outline, x, footprint.same); };
    if (!footprint.isOnEdge() && std::all_of(corners.begin(), corners.end(), isTaken)) return false;
    if (!isParted(outline, corners) && !isParted(corners, outline)) return true;
    const double distance =
        std::min(distanceOfCorners(corners, outline), distanceOfCorners(outline, corners));
    return side > kOfDistance * distance;
}

std::optional<Vec3> crossing(const Footprint& footprint, const Vec3& begin, const Vec3& end) {
    const Vec2 first = footprint.plane.toPlane(begin), last = footprint.plane.toPlane(end);
    const double length = (last - first).norm();
    const auto placeAt = [&](double share) -> std::optional<Vec3> {
        if (!(std::min(share, 1 - share) * length > footprint.same)) return std::nullopt;
        return (1 - share) * begin + share * end;
    };
    const std::vector<Vec2>& outline = footprint.corners;
    if (footprint.isOnEdge()) {
        if (!isOnOutline(footprint, begin, end)) return std::nullopt;
        for (const Vec2& corner : outline)
            if (auto place = placeAt((corner - first).dot(last - first) / (length * length))) return place;
        return std::nullopt;
    }
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec2 &from = outline[i], &to = outline[(i + 1) % outline.size()];
        const double before = leftOf(from, to, first), after = leftOf(from, to, last);
        if (before * after >= 0 || std::min(std::abs(before), std::abs(after)) <= footprint.same) continue;
        const double share = before / (before - after);
        const Vec2 met = first + share * (last - first);
        if (isInside(outline, met, footprint.same))
            if (auto place = placeAt(share)) return place;
    }
    return std::nullopt;
}

bool isOnOutline(const Footprint& footprint, const Vec3& begin, const Vec3& end) {
    const Vec2 first = footprint.plane.toPlane(begin), last = footprint.plane.toPlane(end);
    const std::vector<Vec2>& outline = footprint.corners;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec2 &from = outline[i], &to = outline[(i + 1) % outline.size()];
        if (std::abs(leftOf(from, to, first)) <= footprint.same &&
            std::abs(leftOf(from, to, last)) <= footprint.same)
            return true;
    }
    return false;
}

}  // namespace talus::flow
