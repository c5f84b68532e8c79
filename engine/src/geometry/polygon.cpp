#include "geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {
namespace {

// Vertices nearer than this share of the extent are one.
constexpr double kMerge = 1e-12;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Calls `visit(b, c, double area)` for the fan of triangles at the first vertex, corners relative to it.
template <class Visit>
void forEachFanTriangle(const Polygon& polygon, Visit visit) {
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const Vec2 b = polygon[i - 1] - polygon[0], c = polygon[i] - polygon[0];
        visit(b, c, cross(b, c));
    }
}

/// What counts as equal [m]; never less than the rounding of the coordinates.
double mergeDistance(const Polygon& polygon) {
    double magnitude = 0;
    for (const Vec2& p : polygon) magnitude = std::max(magnitude, p.cwiseAbs().maxCoeff());
    return std::max(kMerge * extent(polygon), 4 * std::numeric_limits<double>::epsilon() * magnitude);
}

Polygon mergeVertices(const Polygon& polygon, double distance) {
    const auto near = [&](const Vec2& a, const Vec2& b) {
        return (a - b).squaredNorm() <= distance * distance;
    };
    Polygon merged;
    for (const Vec2& p : polygon)
        if (merged.empty() || !near(p, merged.back())) merged.push(p);
    while (merged.size() > 1 && near(merged.back(), merged[0])) merged.pop();
    return merged;
}

/// The part on the negative side of a line through `point` with unit `normal`; vertices within `tolerance` of
/// the line are kept as they are.
Polygon cut(const Polygon& polygon, const Vec2& normal, const Vec2& point, double tolerance) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 &a = polygon[i], &b = polygon.next(i);
        const double height_a = normal.dot(a - point), height_b = normal.dot(b - point);
        if (height_a <= tolerance) kept.push(a);
        const bool crosses =
            std::min(height_a, height_b) < -tolerance && std::max(height_a, height_b) > tolerance;
        if (crosses) kept.push(a + (b - a) * (height_a / (height_a - height_b)));
    }
    return kept;
}

/// A clipped polygon, tidied up: empty when it is only a sliver of `whole` [m^2].
Polygon tidied(const Polygon& clipped, double tolerance, double whole) {
    const Polygon merged = mergeVertices(clipped, tolerance);
    return merged.size() >= 3 && area(merged) > kSliver * whole ? merged : Polygon{};
}

}  // namespace

Polygon& Polygon::operator=(const Polygon& other) {
    if (this == &other) return *this;
    heap_ = other.heap_;
    size_ = other.size_;
    if (heap_.empty()) std::copy(other.begin(), other.end(), inline_.data());
    return *this;
}

void Polygon::push(const Vec2& vertex) {
    const Vec2 copy = vertex;  // may be one of our own
    if (size_ == kInline && heap_.empty()) heap_.assign(inline_.begin(), inline_.end());
    if (heap_.empty())
        inline_[size_] = copy;
    else
        heap_.push_back(copy);
    ++size_;
}

void Polygon::pop() {
    --size_;
    if (heap_.empty()) return;
    heap_.pop_back();
    if (size_ > kInline) return;
    std::copy(heap_.begin(), heap_.end(), inline_.data());
    heap_.clear();
}

void Polygon::clear() {
    size_ = 0;
    heap_.clear();
}

double area(const Polygon& polygon) {
    double doubled = 0;
    forEachFanTriangle(polygon, [&](const Vec2&, const Vec2&, double twice) { doubled += twice; });
    return 0.5 * doubled;
}

Vec2 centroid(const Polygon& polygon) {
    Vec2 moment = Vec2::Zero();
    double doubled = 0;
    forEachFanTriangle(polygon, [&](const Vec2& b, const Vec2& c, double twice) {
        moment += twice * (b + c) / 3.0;
        doubled += twice;
    });
    return polygon[0] + moment / doubled;
}

// Over a triangle (0, b, c) the integral of x x^T is A/12 (s s^T + b b^T + c c^T) with s = b + c; the moments
// about the first vertex are then moved to the origin.
SecondMoments secondMoments(const Polygon& polygon) {
    if (polygon.empty()) return {};
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
    Vec2 first = Vec2::Zero();
    forEachFanTriangle(polygon, [&](const Vec2& b, const Vec2& c, double twice) {
        const Vec2 s = b + c;
        second += twice / 24.0 * (s * s.transpose() + b * b.transpose() + c * c.transpose());
        first += twice / 6.0 * s;
    });
    const Vec2& o = polygon[0];
    second += o * first.transpose() + first * o.transpose() + area(polygon) * o * o.transpose();
    return {second(0, 0), second(0, 1), second(1, 1)};
}

double extent(const Polygon& polygon) {
    if (polygon.empty()) return 0;
    Vec2 min = polygon[0], max = polygon[0];
    for (const Vec2& p : polygon) min = min.cwiseMin(p), max = max.cwiseMax(p);
    return (max - min).maxCoeff();
}

Polygon clipHalfPlane(const Polygon& polygon, const Vec2& normal, double offset) {
    if (polygon.empty()) return {};
    const double tolerance = mergeDistance(polygon), length = normal.norm();
    const Vec2 unit = normal / length;
    return tidied(cut(polygon, unit, unit * (offset / length), tolerance), tolerance, area(polygon));
}

Polygon intersect(const Polygon& a, const Polygon& b) {
    const double tolerance = std::max(mergeDistance(a), mergeDistance(b));
    Polygon common = a;
    for (std::size_t i = 0; i < b.size() && !common.empty(); ++i) {
        const Vec2 edge = b.next(i) - b[i];
        const double length = edge.norm();
        if (length > tolerance) common = cut(common, Vec2(edge.y(), -edge.x()) / length, b[i], tolerance);
    }
    return b.empty() ? Polygon{} : tidied(common, tolerance, std::min(area(a), area(b)));
}

Polygon simplify(const Polygon& polygon, double tolerance) {
    const Polygon merged = mergeVertices(polygon, tolerance);
    Polygon kept;
    for (std::size_t i = 0; i < merged.size(); ++i) {
        const Vec2& before = kept.empty() ? merged.back() : kept.back();
        const Vec2 chord = merged.next(i) - before;
        if (cross(merged[i] - before, chord) > tolerance * chord.norm()) kept.push(merged[i]);
    }
    return kept.size() >= 3 ? kept : Polygon{};
}

}  // namespace talus
