#include "law/points.h"

#include <cmath>

namespace talus::contact {
namespace {

using Vec2 = Eigen::Vector2d;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

double triangleArea(const Vec2& a, const Vec2& b, const Vec2& c) { return 0.5 * cross(b - a, c - a); }

Vec2 patchCentroid(std::span<const Vec2> patch) {
    Vec2 sum = Vec2::Zero();
    double area = 0;
    for (std::size_t i = 1; i + 1 < patch.size(); ++i) {
        const double a = triangleArea(patch[0], patch[i], patch[i + 1]);
        sum += a * ((patch[i] - patch[0]) + (patch[i + 1] - patch[0])) / 3.0;
        area += a;
    }
    return patch[0] + sum / area;
}

/// On each triangle of the centroid fan the rule "3/4 at the centroid, 1/12 at each vertex" integrates
/// quadratics exactly (Strang and Fix 1973, ch. 4.3); neighbours share their vertices' parts.
std::vector<PatchPoint> vertexPoints(std::span<const Vec2> patch) {
    const std::size_t m = patch.size();
    const Vec2 centre = patchCentroid(patch);
    std::vector<PatchPoint> points(2 * m + 1);
    for (std::size_t i = 0; i < m; ++i) points[i] = {patch[i], 0.0};
    points[m] = {centre, 0.0};
    for (std::size_t i = 0; i < m; ++i) {
        const std::size_t next = (i + 1) % m;
        const double area = triangleArea(centre, patch[i], patch[next]);
        points[i].area += area / 12;
        points[next].area += area / 12;
        points[m].area += area / 12;
        points[m + 1 + i] = {(centre + patch[i] + patch[next]) / 3, 0.75 * area};
    }
    return points;
}

std::vector<PatchPoint> quarterPoints(std::span<const Vec2> patch) {
    const std::size_t m = patch.size();
    const Vec2 centre = patchCentroid(patch);
    std::vector<PatchPoint> points(m);
    for (std::size_t i = 0; i < m; ++i) {
        const Vec2 before = (patch[(i + m - 1) % m] + patch[i]) / 2;
        const Vec2 after = (patch[i] + patch[(i + 1) % m]) / 2;
        const double area_1 = triangleArea(centre, before, patch[i]);
        const double area_2 = triangleArea(centre, patch[i], after);
        const Vec2 moment =
            (area_1 * (centre + before + patch[i]) + area_2 * (centre + patch[i] + after)) / 3;
        points[i] = {moment / (area_1 + area_2), area_1 + area_2};
    }
    return points;
}

std::vector<PatchPoint> cornerPoints(std::span<const Vec2> patch) {
    double area = 0;
    for (std::size_t i = 1; i + 1 < patch.size(); ++i) area += triangleArea(patch[0], patch[i], patch[i + 1]);
    std::vector<PatchPoint> points;
    for (const Vec2& vertex : patch) points.push_back({vertex, area / static_cast<double>(patch.size())});
    return points;
}

std::vector<PatchPoint> gridPoints(std::span<const Vec2> patch, int n) {
    const Vec2 side_1 = (patch[1] - patch[0]) / n, side_2 = (patch[3] - patch[0]) / n;
    const double area = cross(side_1, side_2);
    std::vector<PatchPoint> points;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            points.push_back({patch[0] + (i + 0.5) * side_1 + (j + 0.5) * side_2, area});
    return points;
}

}  // namespace

bool isRectangle(std::span<const Vec2> patch) {
    if (patch.size() != 4) return false;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec2 in = patch[(i + 1) % 4] - patch[i], out = patch[(i + 2) % 4] - patch[(i + 1) % 4];
        if (std::abs(in.dot(out)) > 1e-9 * in.norm() * out.norm()) return false;
    }
    return true;
}

std::vector<PatchPoint> patchPoints(std::span<const Vec2> patch, const PointRule& rule) {
    switch (rule.kind) {
        case PointRule::Kind::quarter:
            return quarterPoints(patch);
        case PointRule::Kind::corner:
            return cornerPoints(patch);
        case PointRule::Kind::grid:
            if (isRectangle(patch)) return gridPoints(patch, rule.grid);
            break;
        case PointRule::Kind::vertex:
        case PointRule::Kind::distributed:
            break;
    }
    return vertexPoints(patch);
}

std::size_t pointCount(std::span<const Vec2> patch, const PointRule& rule) {
    if (patch.size() == 1) return 1;
    switch (rule.kind) {
        case PointRule::Kind::quarter:
        case PointRule::Kind::corner:
            return patch.size();
        case PointRule::Kind::grid:
            if (isRectangle(patch))
                return static_cast<std::size_t>(rule.grid) * static_cast<std::size_t>(rule.grid);
            break;
        case PointRule::Kind::vertex:
        case PointRule::Kind::distributed:
            break;
    }
    return 2 * patch.size() + 1;
}

}  // namespace talus::contact
