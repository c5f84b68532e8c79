#include "rock_mass/plane_polygon.h"

#include <algorithm>
#include <numeric>

namespace talus::rock_mass {

namespace {

using Point = PlanePoint;

constexpr double kFlat = 1e-12;  // of the extent squared: corners so flat are straight but for rounding

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

double turn(const Point& a, const Point& b, const Point& c) { return cross(b - a, c - a); }

bool isBetween(const Point& a, const Point& b, const Point& p) { return (p - a).dot(p - b) <= 0; }

bool sidesMeet(const Point& a, const Point& b, const Point& c, const Point& d) {
    if (std::max(a.x(), b.x()) < std::min(c.x(), d.x()) || std::max(c.x(), d.x()) < std::min(a.x(), b.x()))
        return false;
    const double c_side = turn(a, b, c), d_side = turn(a, b, d), a_side = turn(c, d, a),
                 b_side = turn(c, d, b);
    if (c_side == 0 && isBetween(a, b, c)) return true;
    if (d_side == 0 && isBetween(a, b, d)) return true;
    if (a_side == 0 && isBetween(c, d, a)) return true;
    if (b_side == 0 && isBetween(c, d, b)) return true;
    return (c_side > 0) != (d_side > 0) && (a_side > 0) != (b_side > 0) && c_side != 0 && d_side != 0 &&
           a_side != 0 && b_side != 0;
}

bool isEar(const std::vector<Point>& p, const std::vector<std::int32_t>& left, std::size_t at, double least) {
    const std::size_t n = left.size();
    const auto point = [&](std::size_t i) { return p[static_cast<std::size_t>(left[i % n])]; };
    const Point a = point(at + n - 1), b = point(at), c = point(at + 1);
    if (turn(a, b, c) <= least) return false;
    for (std::size_t i = at + 2; i < at + n - 1; ++i) {
        const Point q = point(i);
        if (turn(a, b, q) >= -least && turn(b, c, q) >= -least && turn(c, a, q) >= -least) return false;
    }
    return true;
}

}  // namespace

double doubleArea(const std::vector<Point>& polygon) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sum += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
    return sum;
}

std::optional<PolygonFault> polygonFault(const std::vector<Point>& p) {
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Point &a = p[i], &b = p[(i + 1) % n], &c = p[(i + 2) % n];
        if (turn(a, b, c) == 0 && (c - b).dot(a - b) > 0) return PolygonFault{(i + 1) % n, (i + 1) % n, true};
    }
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 2; j < n; ++j)
            if ((j + 1) % n != i && sidesMeet(p[i], p[i + 1], p[j], p[(j + 1) % n]))
                return PolygonFault{i, j, false};
    return std::nullopt;
}

std::vector<std::array<std::int32_t, 3>> triangulate(const std::vector<Point>& p) {
    std::vector<std::int32_t> left(p.size());
    std::iota(left.begin(), left.end(), 0);
    std::vector<std::array<std::int32_t, 3>> triangles;
    Point low = p[0], high = p[0];
    for (const Point& q : p) low = low.cwiseMin(q), high = high.cwiseMax(q);
    const double flat = kFlat * (high - low).squaredNorm();
    const auto firstEar = [&](double least) {
        std::size_t at = 0;
        while (at < left.size() && !isEar(p, left, at, least)) ++at;
        return at;
    };
    while (left.size() > 3) {
        std::size_t at = firstEar(flat);
        if (at == left.size()) at = firstEar(0);
        if (at == left.size()) return {};
        const std::size_t n = left.size();
        triangles.push_back({left[(at + n - 1) % n], left[at], left[(at + 1) % n]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    }
    triangles.push_back({left[0], left[1], left[2]});
    return triangles;
}

}  // namespace talus::rock_mass
