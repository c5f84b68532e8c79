#include "report/paint_order.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace talus::tools {

namespace {

using Polygons = std::vector<PaintedPolygon>;

constexpr std::size_t kCell = 48;  // polygons that one tree orders
constexpr int kCandidates = 6;     // looked at for a plane that cuts few others
constexpr double kThin = 1e-7;     // of the whole picture: nearer to a plane is on it

struct Plane {
    Vec3 normal = Vec3::UnitZ();
    double offset = 0;

    double distance(const Vec3& point) const { return normal.dot(point) - offset; }
};

Vec3 areaVector(const std::vector<Vec3>& corners) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        sum += (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
    return 0.5 * sum;
}

Plane planeOf(const PaintedPolygon& polygon) {
    Vec3 middle = Vec3::Zero();
    for (const Vec3& corner : polygon.corners) middle += corner;
    middle /= static_cast<double>(polygon.corners.size());
    const Vec3 normal = areaVector(polygon.corners).normalized();
    return {normal, normal.dot(middle)};
}

enum class Place { on, before, behind, across };

Place placeOf(const PaintedPolygon& polygon, const Plane& plane, double thin) {
    bool before = false, behind = false;
    for (const Vec3& corner : polygon.corners) {
        const double distance = plane.distance(corner);
        before = before || distance > thin;
        behind = behind || distance < -thin;
    }
    if (before && behind) return Place::across;
    return before ? Place::before : behind ? Place::behind : Place::on;
}

/// The part of a polygon on one side; `sign` is +1 for what lies before the plane.
PaintedPolygon cutAt(const PaintedPolygon& polygon, const Plane& plane, double sign) {
    PaintedPolygon part{{}, {}, polygon.source};
    const std::size_t n = polygon.corners.size();
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 &a = polygon.corners[k], &b = polygon.corners[(k + 1) % n];
        const double at_a = sign * plane.distance(a), at_b = sign * plane.distance(b);
        if (at_a >= 0) {
            part.corners.push_back(a);
            part.sides.push_back(polygon.sides[k]);
        }
        if ((at_a >= 0) == (at_b >= 0)) continue;
        part.corners.push_back(a + (b - a) * (at_a / (at_a - at_b)));
        // Going out, the cut follows; coming in, the rest of this side.
        part.sides.push_back(at_a >= 0 ? Side::none : polygon.sides[k]);
    }
    return part;
}

/// A picture in the making.
class Painter {
 public:
    explicit Painter(double extent) : thin_(kThin * extent), least_area_(thin_ * thin_) {}

    /// Cells beside each other do not hide each other: their planes contain the direction of view.
    void paintCells(Polygons polygons) {
        if (polygons.size() <= kCell) return paintTree(std::move(polygons));
        const Plane plane = middle(polygons);
        const std::size_t count = polygons.size();
        auto [left, right] = parted(std::move(polygons), plane);
        if (10 * std::max(left.size(), right.size()) > 9 * count) {
            std::move(right.begin(), right.end(), std::back_inserter(left));
            return paintTree(std::move(left));
        }
        paintCells(std::move(left));
        paintCells(std::move(right));
    }

    Polygons take() { return std::move(painted_); }

 private:
    bool counts(const PaintedPolygon& polygon) const {
        return polygon.corners.size() > 2 && areaVector(polygon.corners).norm() > least_area_;
    }

    /// Across the longer way of the picture, through the middle polygon.
    static Plane middle(const Polygons& polygons) {
        std::vector<double> places[2];
        for (const PaintedPolygon& polygon : polygons)
            for (int axis = 0; axis < 2; ++axis) places[axis].push_back(polygon.corners.front()[axis]);
        double extent[2], median[2];
        for (int axis = 0; axis < 2; ++axis) {
            auto& list = places[axis];
            std::sort(list.begin(), list.end());
            extent[axis] = list.back() - list.front();
            median[axis] = list[list.size() / 2];
        }
        const int axis = extent[1] > extent[0] ? 1 : 0;
        return {axis == 0 ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitY()), median[axis]};
    }

    std::pair<Polygons, Polygons> parted(Polygons polygons, const Plane& plane) const {
        std::pair<Polygons, Polygons> parts;
        for (PaintedPolygon& polygon : polygons) {
            switch (placeOf(polygon, plane, thin_)) {
                case Place::across:
                    add(cutAt(polygon, plane, -1), parts.first);
                    add(cutAt(polygon, plane, 1), parts.second);
                    break;
                case Place::before:
                    parts.second.push_back(std::move(polygon));
                    break;
                default:
                    parts.first.push_back(std::move(polygon));
            }
        }
        return parts;
    }

    void add(PaintedPolygon part, Polygons& list) const {
        if (counts(part)) list.push_back(std::move(part));
    }

    /// The plane of the candidate that cuts the fewest others.
    Plane splitter(const Polygons& polygons) const {
        Plane best;
        std::size_t fewest = polygons.size() + 1;
        const std::size_t stride = std::max<std::size_t>(1, polygons.size() / kCandidates);
        for (std::size_t k = stride / 2; k < polygons.size(); k += stride) {
            const Plane plane = planeOf(polygons[k]);
            const auto cuts = static_cast<std::size_t>(
                std::count_if(polygons.begin(), polygons.end(), [&](const PaintedPolygon& polygon) {
                    return placeOf(polygon, plane, thin_) == Place::across;
                }));
            if (cuts >= fewest) continue;
            fewest = cuts;
            best = plane;
        }
        return best;
    }

    /// All polygons face the reader, so those behind a plane are painted before its own polygons, and those
    /// in front after them.
    void paintTree(Polygons polygons) {
        if (polygons.size() < 2) {
            for (PaintedPolygon& polygon : polygons) painted_.push_back(std::move(polygon));
            return;
        }
        const Plane plane = splitter(polygons);
        Polygons behind, on, before;
        for (PaintedPolygon& polygon : polygons) {
            const Place place = placeOf(polygon, plane, thin_);
            if (place == Place::across) {
                add(cutAt(polygon, plane, -1), behind);
                add(cutAt(polygon, plane, 1), before);
            } else {
                (place == Place::on       ? on
                 : place == Place::behind ? behind
                                          : before)
                    .push_back(std::move(polygon));
            }
        }
        if (on.empty()) {  // the plane's own polygon is thinner than its distance is accurate
            on = std::exchange(behind.empty() ? before : behind, {});
            std::move(before.begin(), before.end(), std::back_inserter(on));
            before.clear();
        }
        paintTree(std::move(behind));
        std::move(on.begin(), on.end(), std::back_inserter(painted_));
        paintTree(std::move(before));
    }

    double thin_, least_area_;
    Polygons painted_;
};

}  // namespace

std::vector<PaintedPolygon> paintOrder(std::vector<PaintedPolygon> polygons) {
    Vec3 low = Vec3::Constant(1e300), high = -low;
    for (const PaintedPolygon& polygon : polygons)
        for (const Vec3& corner : polygon.corners) {
            low = low.cwiseMin(corner);
            high = high.cwiseMax(corner);
        }
    if (polygons.empty()) return polygons;
    Painter painter((high - low).norm());
    painter.paintCells(std::move(polygons));
    return painter.take();
}

}  // namespace talus::tools
