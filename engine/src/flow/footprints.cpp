#include "flow/footprints.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "flow/places.h"
#include "geometry/box_clip.h"

namespace talus::flow {
namespace {

// bench/studies/drain-in-a-joint.md has what half and twice these do to the discharge and to the mesh.
constexpr double kOfDistance = 0.5;     // longest side over the distance from the outline, at most
constexpr double kOfWidth = 1.0 / 8;    // longest side on an outline over its width
constexpr double kOfLength = 1.0 / 64;  // the same over its length, where it is thin

constexpr double kBeyond = 4;  // diameters of a patch: as far as a boundary is looked at beyond it

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

/// One patch of the network, which is a fan of triangles.
class Fan {
 public:
    Fan(const Network& network, std::size_t first, std::size_t end)
        : patch_(network.patch_of[first]), same_(network.same[static_cast<std::size_t>(patch_)]) {
        nodes_.push_back(network.corner(first, 0));
        plane_ = faceFrame(nodes_[0], network.corner(first, 1), network.patch(first).normal);
        for (std::size_t t = first; t < end; ++t) {
            nodes_.push_back(network.corner(t, 1));
            outline_.push(plane_.toPlane(nodes_.back()));
        }
        diameter_ = lengthOf(outline_);
    }

    /// Of a boundary of joints; nothing where the mesh need be no finer.
    std::optional<Footprint> inPlane(const Vec3& low, const Vec3& high) const {
        const double far = kBeyond * diameter_;
        const Polygon whole =
            clippedToBox({{-far, -far}, {far, -far}, {far, far}, {-far, far}}, plane_, low, high, same_);
        if (whole.empty()) return std::nullopt;
        const Polygon taken = clippedToBox(outline_, plane_, low, high, same_);
        const double width = widthOf(whole), length = std::min(lengthOf(whole), diameter_);
        double size = kOfWidth * width;
        if (!endsInside(whole, widthOf(taken) <= same_)) {
            if (widthOf(taken) <= same_ || isAllIn(low, high)) return std::nullopt;
            size = width / 2;
        }
        return footprint({whole.begin(), whole.end()}, std::max(size, kOfLength * length), low, high);
    }

    /// Of a boundary of open ends, on this edge.
    std::optional<Footprint> onEdge(const Vec3& begin, const Vec3& end, const Vec3& low,
                                    const Vec3& high) const {
        const Vec3 beyond = kBeyond * (end - begin), from = begin - beyond, way = end + beyond - from;
        const Stretch stretch = stretchInBox(from, from + way, low, high);
        const double length = (stretch.to - stretch.from) * way.norm();
        if (!(length > same_)) return std::nullopt;
        const Vec3 first = from + stretch.from * way, last = from + stretch.to * way;
        const auto isWithin = [&](const Vec3& x) {
            return (x - begin).dot(way) > same_ * way.norm() && (end - x).dot(way) > same_ * way.norm();
        };
        if (!isWithin(first) && !isWithin(last)) return std::nullopt;
        return footprint({plane_.toPlane(first), plane_.toPlane(last)}, kOfWidth * length, low, high);
    }

 private:
    Footprint footprint(std::vector<Vec2> corners, double size, const Vec3& low, const Vec3& high) const {
        return {patch_, plane_, std::move(corners), low, high, size, same_};
    }

    /// Whether a corner lies within the patch; if the box only touches the patch, on one of its edges.
    bool endsInside(const Polygon& whole, bool touches) const {
        return std::any_of(whole.begin(), whole.end(), [&](const Vec2& corner) {
            double inside = kInfinity;
            int edges = 0;
            for (std::size_t i = 0; i < outline_.size(); ++i) {
                const double left = leftOf(outline_[i], outline_.next(i), corner);
                inside = std::min(inside, left);
                if (std::abs(left) <= same_) ++edges;
            }
            return inside > same_ || (touches && inside >= -same_ && edges == 1);
        });
    }

    bool isAllIn(const Vec3& low, const Vec3& high) const {
        return std::all_of(nodes_.begin(), nodes_.end(),
                           [&](const Vec3& x) { return isInBox(x, low, high, same_); });
    }

    std::int32_t patch_;
    double same_;  ///< [m]
    std::vector<Vec3> nodes_;
    FaceFrame plane_;
    Polygon outline_;
    double diameter_ = 0;  ///< [m]
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

bool isInside(std::span<const Vec2> outline, const Vec2& x, double margin) {
    for (std::size_t i = 0; i < outline.size(); ++i)
        if (leftOf(outline[i], outline[(i + 1) % outline.size()], x) < -margin) return false;
    return true;
}

}  // namespace

std::vector<Footprint> footprintsOf(const Network& network, std::span<const FlowBoundary> boundaries,
                                    const Vec3& origin) {
    std::vector<Footprint> footprints;
    const auto add = [&](std::optional<Footprint> footprint) {
        if (footprint) footprints.push_back(std::move(*footprint));
    };
    const std::vector<Fan> fans = fansOf(network);
    const std::vector<OpenEdge> edges = openEdges(network);
    for (const FlowBoundary& boundary : boundaries) {
        const Vec3 low = boundary.box_min - origin, high = boundary.box_max - origin;
        if (boundary.face) {
            for (const OpenEdge& edge : edges)
                if (takesJoint(boundary, network.patch(edge.triangle).joint) &&
                    takesFace(boundary, edge.outward))
                    add(fans[static_cast<std::size_t>(network.patch_of[edge.triangle])].onEdge(
                        network.nodes[static_cast<std::size_t>(edge.nodes[0])],
                        network.nodes[static_cast<std::size_t>(edge.nodes[1])], low, high));
            continue;
        }
        for (std::size_t p = 0; p < fans.size(); ++p)
            if (takesJoint(boundary, network.patches[p].joint)) add(fans[p].inPlane(low, high));
    }
    return footprints;
}

double mostSide(const Footprint& footprint, const std::array<Vec3, 3>& triangle) {
    const std::span<const Vec2> outline = footprint.corners;
    std::array<Vec2, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = footprint.plane.toPlane(triangle[k]);
    const auto isTaken = [&](const Vec2& x) { return isInside(outline, x, footprint.same); };
    if (outline.size() > 2 && std::all_of(corners.begin(), corners.end(), isTaken)) return kInfinity;
    if (!isParted(outline, corners) && !isParted(corners, outline)) return footprint.size;
    const double distance =
        std::min(distanceOfCorners(corners, outline), distanceOfCorners(outline, corners));
    return std::max(footprint.size, kOfDistance * distance);
}

}  // namespace talus::flow
