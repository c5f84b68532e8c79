// Closed surfaces of triangles: what is wrong with one, and the ones made from boxes and slope profiles.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>

#include "talus/rock_mass.h"

namespace talus {
namespace {

using Point = Eigen::Vector2d;
using Edge = std::pair<std::int32_t, std::int32_t>;

constexpr std::size_t kMostFaults = 20;
constexpr double kFlatArea = 1e-14;  // of the extent squared: a triangle of less has no direction

std::string text(double value) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string text(const Vec3& p) { return "(" + text(p.x()) + ", " + text(p.y()) + ", " + text(p.z()) + ")"; }

std::string triangleField(std::size_t triangle) { return "triangles[" + std::to_string(triangle) + "]"; }

double extentOf(const std::vector<Vec3>& points) {
    Vec3 min = points[0], max = points[0];
    for (const Vec3& p : points) min = min.cwiseMin(p), max = max.cwiseMax(p);
    return (max - min).maxCoeff();
}

std::vector<Error> indexErrors(const TriangleSurface& surface) {
    std::vector<Error> errors;
    const auto count = static_cast<std::int32_t>(surface.vertices.size());
    for (std::size_t v = 0; v < surface.vertices.size() && errors.size() < kMostFaults; ++v)
        if (!surface.vertices[v].allFinite())
            errors.push_back({"vertices[" + std::to_string(v) + "]", "coordinates must be finite"});
    for (std::size_t t = 0; t < surface.triangles.size() && errors.size() < kMostFaults; ++t)
        for (const std::int32_t v : surface.triangles[t])
            if (v < 0 || v >= count)
                errors.push_back({triangleField(t), "found vertex " + std::to_string(v) + ", allowed: 0 to " +
                                                        std::to_string(count - 1)});
    return errors;
}

std::vector<Error> flatErrors(const TriangleSurface& surface, double extent) {
    std::vector<Error> errors;
    for (std::size_t t = 0; t < surface.triangles.size() && errors.size() < kMostFaults; ++t) {
        const auto& [a, b, c] = surface.triangles[t];
        const Vec3 &p = surface.vertices[static_cast<std::size_t>(a)],
                   &q = surface.vertices[static_cast<std::size_t>(b)],
                   &r = surface.vertices[static_cast<std::size_t>(c)];
        if ((q - p).cross(r - p).norm() <= kFlatArea * extent * extent)
            errors.push_back({triangleField(t), "found a triangle without area at " + text(p) +
                                                    ", allowed: three corners that span a plane"});
    }
    return errors;
}

/// The triangles along each directed edge.
std::map<Edge, std::vector<std::size_t>> directedEdges(const TriangleSurface& surface) {
    std::map<Edge, std::vector<std::size_t>> edges;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
            edges[{surface.triangles[t][i], surface.triangles[t][(i + 1) % 3]}].push_back(t);
    return edges;
}

std::vector<Error> edgeErrors(const TriangleSurface& surface) {
    std::vector<Error> errors;
    const auto edges = directedEdges(surface);
    for (const auto& [edge, along] : edges) {
        if (errors.size() >= kMostFaults) break;
        const auto twin = edges.find({edge.second, edge.first});
        const std::size_t against = twin == edges.end() ? 0 : twin->second.size();
        const std::string place = "the edge from " +
                                  text(surface.vertices[static_cast<std::size_t>(edge.first)]) + " to " +
                                  text(surface.vertices[static_cast<std::size_t>(edge.second)]);
        const std::string others = along.size() > 1 ? " and " + triangleField(along[1]) : "";
        if (along.size() + against == 1)
            errors.push_back({triangleField(along[0]),
                              "found an open surface: " + place + " has one triangle only, allowed: two"});
        else if (along.size() + against == 2 && against == 0)
            errors.push_back(
                {triangleField(along[0]), "found triangles that face opposite ways along " + place + others +
                                              ", allowed: corners counter-clockwise seen from outside"});
        else if (along.size() + against > 2 && (against == 0 || edge.first < edge.second))
            errors.push_back({triangleField(along[0]), "found a non-manifold surface: " + place + " has " +
                                                           std::to_string(along.size() + against) +
                                                           " triangles, allowed: two"});
    }
    return errors;
}

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

double doubleArea(const std::vector<Point>& polygon) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sum += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
    return sum;
}

double turn(const Point& a, const Point& b, const Point& c) { return cross(b - a, c - a); }

bool isBetween(const Point& a, const Point& b, const Point& p) { return (p - a).dot(p - b) <= 0; }

bool sidesMeet(const Point& a, const Point& b, const Point& c, const Point& d) {
    const double c_side = turn(a, b, c), d_side = turn(a, b, d), a_side = turn(c, d, a),
                 b_side = turn(c, d, b);
    if (c_side == 0 && isBetween(a, b, c)) return true;
    if (d_side == 0 && isBetween(a, b, d)) return true;
    if (a_side == 0 && isBetween(c, d, a)) return true;
    if (b_side == 0 && isBetween(c, d, b)) return true;
    return (c_side > 0) != (d_side > 0) && (a_side > 0) != (b_side > 0) && c_side != 0 && d_side != 0 &&
           a_side != 0 && b_side != 0;
}

std::vector<Error> profileErrors(const std::vector<Point>& p) {
    const std::size_t n = p.size();
    if (n < 3) return {{"", "found " + std::to_string(n) + " points, allowed: at least three"}};
    const auto field = [](std::size_t i) { return "[" + std::to_string(i) + "]"; };
    for (std::size_t i = 0; i < n; ++i) {
        if (!p[i].allFinite()) return {{field(i), "coordinates must be finite"}};
        if (p[i] == p[(i + 1) % n])
            return {{field((i + 1) % n),
                     "found the point of " + field(i) + " again, allowed: a point of its own"}};
        const Point &a = p[i], &b = p[(i + 1) % n], &c = p[(i + 2) % n];
        if (turn(a, b, c) == 0 && (c - b).dot(a - b) > 0)
            return {{field((i + 1) % n),
                     "found a profile that turns back on itself, allowed: sides that do not touch"}};
    }
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 2; j < n; ++j)
            if ((j + 1) % n != i && sidesMeet(p[i], p[i + 1], p[j], p[(j + 1) % n]))
                return {{field(j), "found a side that meets the one behind point " + field(i) +
                                       ", allowed: sides that do not cross or touch"}};
    return {};
}

bool isEar(const std::vector<Point>& p, const std::vector<std::int32_t>& left, std::size_t at) {
    const std::size_t n = left.size();
    const auto point = [&](std::size_t i) { return p[static_cast<std::size_t>(left[i % n])]; };
    const Point a = point(at + n - 1), b = point(at), c = point(at + 1);
    if (turn(a, b, c) <= 0) return false;
    for (std::size_t i = at + 2; i < at + n - 1; ++i) {
        const Point q = point(i);
        if (turn(a, b, q) >= 0 && turn(b, c, q) >= 0 && turn(c, a, q) >= 0) return false;
    }
    return true;
}

/// Cuts off ears of a counter-clockwise simple polygon; corners on straight sides are used up last.
std::vector<std::array<std::int32_t, 3>> triangulate(const std::vector<Point>& p) {
    std::vector<std::int32_t> left(p.size());
    std::iota(left.begin(), left.end(), 0);
    std::vector<std::array<std::int32_t, 3>> triangles;
    while (left.size() > 3) {
        std::size_t at = 0;
        while (at < left.size() && !isEar(p, left, at)) ++at;
        if (at == left.size()) return {};
        const std::size_t n = left.size();
        triangles.push_back({left[(at + n - 1) % n], left[at], left[(at + 1) % n]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    }
    triangles.push_back({left[0], left[1], left[2]});
    return triangles;
}

}  // namespace

double surfaceVolume(const TriangleSurface& surface) {
    if (surface.vertices.empty()) return 0;
    const Vec3 origin = surface.vertices[0];
    double sixfold = 0;
    for (const auto& [a, b, c] : surface.triangles)
        sixfold += (surface.vertices[static_cast<std::size_t>(a)] - origin)
                       .dot((surface.vertices[static_cast<std::size_t>(b)] - origin)
                                .cross(surface.vertices[static_cast<std::size_t>(c)] - origin));
    return sixfold / 6;
}

std::vector<Error> checkSurface(const TriangleSurface& surface) {
    if (surface.triangles.empty()) return {{"", "found no triangles, allowed: a closed surface"}};
    auto errors = indexErrors(surface);
    if (!errors.empty()) return errors;
    const double extent = extentOf(surface.vertices);
    errors = flatErrors(surface, extent);
    if (errors.empty()) errors = edgeErrors(surface);
    if (!errors.empty()) return errors;
    const double volume = surfaceVolume(surface);
    if (!(volume > 0))
        return {{"", "found an inverted surface, which faces inwards (volume " + text(volume) +
                         " m3), allowed: triangles counter-clockwise seen from outside"}};
    return {};
}

Result<TriangleSurface> boxSurface(const Vec3& min, const Vec3& max) {
    const auto box = makeBox(min, max);
    if (!box) return box.errors();
    TriangleSurface surface{box->vertices, {}};
    for (const auto& face : box->faces)
        for (std::size_t i = 2; i < face.size(); ++i)
            surface.triangles.push_back({face[0], face[i - 1], face[i]});
    return surface;
}

Result<TriangleSurface> extrudeProfile(const std::vector<Point>& profile, double y_min, double y_max) {
    if (!(y_min < y_max) || !std::isfinite(y_max - y_min))
        return Error{"y", "found " + text(y_min) + " to " + text(y_max) + ", allowed: the lesser first"};
    if (auto errors = profileErrors(profile); !errors.empty()) return errors;
    std::vector<Point> p = profile;
    if (doubleArea(p) < 0) std::reverse(p.begin(), p.end());
    const auto caps = triangulate(p);
    if (caps.empty())
        return Error{"", "found a profile too narrow for its extent, allowed: sides that do not touch"};
    TriangleSurface surface;
    for (const double y : {y_min, y_max})
        for (const Point& q : p) surface.vertices.emplace_back(q.x(), y, q.y());
    const auto n = static_cast<std::int32_t>(p.size());
    // Counter-clockwise in (x, z) is seen from -y: the cap at y_min as it is, the other one reversed.
    for (const auto& [a, b, c] : caps) {
        surface.triangles.push_back({a, b, c});
        surface.triangles.push_back({n + a, n + c, n + b});
    }
    for (std::int32_t i = 0; i < n; ++i) {
        const std::int32_t j = (i + 1) % n;
        surface.triangles.push_back({i, n + i, n + j});
        surface.triangles.push_back({i, n + j, j});
    }
    return surface;
}

}  // namespace talus
