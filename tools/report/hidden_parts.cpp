#include "report/hidden_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus::tools {

namespace {

constexpr double kThin = 1e-4;           // of the picture: what is seen along an edge, or of a sliver
constexpr std::size_t kMostPieces = 64;  // of a polygon covered piece by piece: least visible part

struct Box {
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};

    void add(const Vec3& point) {
        for (int axis = 0; axis < 2; ++axis) {
            low[axis] = std::min(low[axis], point[axis]);
            high[axis] = std::max(high[axis], point[axis]);
        }
    }
    bool meets(const Box& other) const {
        return low[0] < other.high[0] && other.low[0] < high[0] && low[1] < other.high[1] &&
               other.low[1] < high[1];
    }
};

Box boxOf(const std::vector<Vec3>& corners) {
    Box box;
    for (const Vec3& corner : corners) box.add(corner);
    return box;
}

/// How far inside of a side of a polygon, which runs counterclockwise, a point lies in the picture.
double inside(const std::vector<Vec3>& corners, std::size_t side, const Vec3& point) {
    const Vec3 &a = corners[side], &b = corners[(side + 1) % corners.size()];
    const double length = std::hypot(b.x() - a.x(), b.y() - a.y());
    if (!(length > 0)) return HUGE_VAL;
    return ((b.x() - a.x()) * (point.y() - a.y()) - (b.y() - a.y()) * (point.x() - a.x())) / length;
}

/// Which polygons lie about a place of the picture, by a grid over it.
class Places {
 public:
    explicit Places(const std::vector<PaintedPolygon>& polygons) {
        for (const PaintedPolygon& polygon : polygons) {
            boxes_.push_back(boxOf(polygon.corners));
            for (const Vec3& corner : polygon.corners) all_.add(corner);
        }
        per_side_ = std::max<std::size_t>(
            1, static_cast<std::size_t>(std::sqrt(static_cast<double>(polygons.size()))));
        cells_.resize(per_side_ * per_side_);
        for (std::size_t k = 0; k < polygons.size(); ++k)
            eachCell(boxes_[k], [&](std::vector<std::size_t>& cell) { cell.push_back(k); });
    }

    double extent() const { return std::hypot(all_.high[0] - all_.low[0], all_.high[1] - all_.low[1]); }

    /// Those painted after the one of this number whose boxes meet a box, in the order of painting.
    std::vector<std::size_t> later(std::size_t than, const Box& box) {
        std::vector<std::size_t> found;
        eachCell(box, [&](const std::vector<std::size_t>& cell) {
            for (auto at = std::upper_bound(cell.begin(), cell.end(), than); at != cell.end(); ++at)
                if (boxes_[*at].meets(box)) found.push_back(*at);
        });
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    }

 private:
    template <typename Do>
    void eachCell(const Box& box, const Do& act) {
        std::size_t from[2], to[2];
        for (int axis = 0; axis < 2; ++axis) {
            const double width = all_.high[axis] - all_.low[axis];
            const auto cell = [&](double at) {
                const double share = width > 0 ? (at - all_.low[axis]) / width : 0;
                return std::min(per_side_ - 1, static_cast<std::size_t>(std::max(0.0, share) *
                                                                        static_cast<double>(per_side_)));
            };
            from[axis] = cell(box.low[axis]);
            to[axis] = cell(box.high[axis]);
        }
        for (std::size_t y = from[1]; y <= to[1]; ++y)
            for (std::size_t x = from[0]; x <= to[0]; ++x) act(cells_[x + per_side_ * y]);
    }

    std::vector<Box> boxes_;
    std::vector<std::vector<std::size_t>> cells_;
    Box all_;
    std::size_t per_side_ = 1;
};

/// Whether a convex outline is wider than `thin`, by its area and its longest way.
bool isWide(const std::vector<Vec3>& corners, double thin) {
    double twice = 0, longest = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec3 &a = corners[k], &b = corners[(k + 1) % corners.size()];
        twice += a.x() * b.y() - b.x() * a.y();
        longest = std::max(longest, std::hypot(a.x() - corners[0].x(), a.y() - corners[0].y()));
    }
    return corners.size() > 2 && 0.5 * std::abs(twice) > thin * longest && longest > thin;
}

/// The part of a convex outline on one side of an edge of another, outside with `sign` -1.
std::vector<Vec3> cutAtSide(const std::vector<Vec3>& outline, const std::vector<Vec3>& other,
                            std::size_t side, double sign) {
    std::vector<Vec3> part;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec3 &a = outline[k], &b = outline[(k + 1) % outline.size()];
        const double at_a = sign * inside(other, side, a), at_b = sign * inside(other, side, b);
        if (at_a >= 0) part.push_back(a);
        if ((at_a >= 0) != (at_b >= 0) && std::isfinite(at_a) && std::isfinite(at_b))
            part.push_back(a + (b - a) * (at_a / (at_a - at_b)));
    }
    return part;
}

/// Subtracts the cover from a convex outline; the rest is convex pieces.
void uncovered(std::vector<Vec3> outline, const std::vector<Vec3>& cover, double thin,
               std::vector<std::vector<Vec3>>& pieces) {
    for (std::size_t side = 0; side < cover.size() && isWide(outline, thin); ++side) {
        std::vector<Vec3> outside = cutAtSide(outline, cover, side, -1);
        if (isWide(outside, thin)) pieces.push_back(std::move(outside));
        outline = cutAtSide(outline, cover, side, 1);
    }
}

bool isCovered(const std::vector<PaintedPolygon>& painted, std::size_t k, Places& places, double thin) {
    std::vector<std::vector<Vec3>> left;
    if (isWide(painted[k].corners, thin)) left.push_back(painted[k].corners);
    for (const std::size_t cover : places.later(k, boxOf(painted[k].corners))) {
        if (left.empty() || left.size() > kMostPieces) break;
        std::vector<std::vector<Vec3>> next;
        for (auto& piece : left) uncovered(std::move(piece), painted[cover].corners, thin, next);
        left = std::move(next);
    }
    return left.empty();
}

using Share = std::pair<double, double>;  // of a line: from and to

/// The share of a line that lies in a convex outline, farther than `thin` from its sides.
Share coveredShare(const Vec3& from, const Vec3& to, const std::vector<Vec3>& outline, double thin) {
    Share share{0, 1};
    for (std::size_t side = 0; side < outline.size(); ++side) {
        const double at_from = inside(outline, side, from) - thin, at_to = inside(outline, side, to) - thin;
        if (at_from <= 0 && at_to <= 0) return {0, 0};
        if (at_from > 0 && at_to > 0) continue;
        const double meets = at_from / (at_from - at_to);
        (at_from > 0 ? share.second : share.first) =
            at_from > 0 ? std::min(share.second, meets) : std::max(share.first, meets);
    }
    return share.first < share.second ? share : Share{0, 0};
}

std::vector<Share> shownShares(const Vec3& from, const Vec3& to, std::vector<Share> covered) {
    std::sort(covered.begin(), covered.end());
    std::vector<Share> shown;
    double until = 0;
    for (const Share& share : covered) {
        if (share.first > until) shown.emplace_back(until, share.first);
        until = std::max(until, share.second);
    }
    if (until < 1) shown.emplace_back(until, 1);
    return (to - from).norm() > 0 ? shown : std::vector<Share>{};
}

void addLines(const std::vector<PaintedPolygon>& painted, std::size_t k, Places& places, double thin,
              std::vector<SeenLine>& lines) {
    const PaintedPolygon& polygon = painted[k];
    for (std::size_t side = 0; side < polygon.corners.size(); ++side) {
        if (polygon.sides[side] == Side::none) continue;
        const Vec3 &from = polygon.corners[side], &to = polygon.corners[(side + 1) % polygon.corners.size()];
        Box box = boxOf({from, to});
        for (int axis = 0; axis < 2; ++axis) {  // a line along an axis has none of its own
            box.low[axis] -= thin;
            box.high[axis] += thin;
        }
        std::vector<Share> covered;
        for (const std::size_t cover : places.later(k, box))
            covered.push_back(coveredShare(from, to, painted[cover].corners, thin));
        for (const Share& share : shownShares(from, to, std::move(covered))) {
            lines.push_back(
                {from + share.first * (to - from), from + share.second * (to - from), polygon.sides[side]});
        }
    }
}

}  // namespace

SeenParts seenParts(std::vector<PaintedPolygon> painted) {
    SeenParts seen;
    if (painted.empty()) return seen;
    Places places(painted);
    const double thin = kThin * places.extent();
    std::vector<bool> is_covered(painted.size());
    for (std::size_t k = 0; k < painted.size(); ++k) {
        is_covered[k] = isCovered(painted, k, places, thin);
        if (!is_covered[k]) addLines(painted, k, places, thin, seen.lines);
    }
    std::stable_sort(seen.lines.begin(), seen.lines.end(),
                     [](const SeenLine& a, const SeenLine& b) { return a.side < b.side; });
    for (std::size_t k = 0; k < painted.size(); ++k)
        if (!is_covered[k]) seen.polygons.push_back(std::move(painted[k]));
    return seen;
}

}  // namespace talus::tools
