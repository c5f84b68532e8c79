#include "geometry/merge_facets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace talus {
namespace {

using Edge = std::pair<std::int32_t, std::int32_t>;

/// The triangle on the left of each directed edge.
using EdgeMap = std::map<Edge, std::size_t>;

EdgeMap mapEdges(const std::vector<Triangle>& triangles) {
    EdgeMap left;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (int i = 0; i < 3; ++i) left[{triangles[t][i], triangles[t][(i + 1) % 3]}] = t;
    return left;
}

Vec3 doubleArea(const std::vector<Vec3>& points, const Triangle& t) {
    return (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
}

struct Plane {
    Vec3 origin, normal;

    bool holds(const std::vector<Vec3>& points, const Triangle& t, double flatness) const {
        // A sliver's own normal is noise, so its corners decide; the sign keeps the back of a thin block
        // apart.
        const auto near = [&](std::int32_t p) {
            return std::abs(normal.dot(points[p] - origin)) <= flatness;
        };
        return std::all_of(t.begin(), t.end(), near) && normal.dot(doubleArea(points, t)) > 0;
    }
};

/// The triangles, which one lies beyond each edge, and the region each belongs to (-1: none yet).
struct Surface {
    const std::vector<Vec3>& points;
    const std::vector<Triangle>& triangles;
    EdgeMap left;
    std::vector<int> region;
};

/// Spreads a region from its seed over shared edges, as far as the seed's plane holds.
void growRegion(Surface& surface, std::size_t seed, int region, double flatness) {
    const Triangle& first = surface.triangles[seed];
    const Plane plane{surface.points[first[0]], doubleArea(surface.points, first).normalized()};
    std::vector<std::size_t> front{seed};
    surface.region[seed] = region;
    while (!front.empty()) {
        const Triangle t = surface.triangles[front.back()];
        front.pop_back();
        for (int i = 0; i < 3; ++i) {
            const std::size_t other = surface.left.at({t[(i + 1) % 3], t[i]});
            if (surface.region[other] >= 0) continue;
            if (!plane.holds(surface.points, surface.triangles[other], flatness)) continue;
            surface.region[other] = region;
            front.push_back(other);
        }
    }
}

/// Gives every triangle a region; the largest triangles are the seeds, as their planes are the best known.
void growRegions(Surface& surface, double flatness) {
    const std::size_t n = surface.triangles.size();
    std::vector<double> size(n);
    for (std::size_t t = 0; t < n; ++t)
        size[t] = doubleArea(surface.points, surface.triangles[t]).squaredNorm();
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return size[a] > size[b]; });

    surface.region.assign(n, -1);
    int regions = 0;
    for (const std::size_t seed : order)
        if (surface.region[seed] < 0) growRegion(surface, seed, regions++, flatness);
}

/// The closed loop made of a region's border edges; empty if there is not exactly one simple loop.
Outline walkLoop(const std::map<std::int32_t, std::int32_t>& next) {
    Outline loop;
    if (next.empty()) return loop;
    for (auto at = next.begin(); loop.size() < next.size();) {
        loop.push_back(at->first);
        at = next.find(at->second);
        if (at == next.end()) return {};
        if (at->first == loop.front()) break;
    }
    return loop.size() == next.size() ? loop : Outline{};
}

/// One outline per region, or nothing if a region's border is not one simple loop.
std::vector<Outline> regionOutlines(const Surface& surface) {
    const int regions = 1 + *std::max_element(surface.region.begin(), surface.region.end());
    std::vector<std::map<std::int32_t, std::int32_t>> next(regions);
    for (const auto& [edge, t] : surface.left) {
        const int region = surface.region[t];
        const bool inside = surface.region[surface.left.at({edge.second, edge.first})] == region;
        if (!inside && !next[region].insert(edge).second) return {};
    }
    std::vector<Outline> outlines;
    for (const auto& border : next) {
        outlines.push_back(walkLoop(border));
        if (outlines.back().empty()) return {};
    }
    return outlines;
}

/// A vertex of a polyhedron belongs to three faces at least; one of two faces lies on their common edge.
/// Dropping by count, not by angle, drops it from both faces alike, so the surface stays closed.
void dropCollinear(std::vector<Outline>& outlines, std::size_t point_count) {
    std::vector<int> faces_at(point_count, 0);
    for (const Outline& outline : outlines)
        for (const auto p : outline) ++faces_at[p];
    for (Outline& outline : outlines) std::erase_if(outline, [&](auto p) { return faces_at[p] < 3; });
}

bool isConvex(const std::vector<Vec3>& points, const Outline& outline) {
    const std::size_t n = outline.size();
    if (n < 3) return false;
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 2; i < n; ++i)
        normal += doubleArea(points, {outline[0], outline[i - 1], outline[i]});
    for (std::size_t i = 0; i < n; ++i)
        if (normal.dot(doubleArea(points, {outline[i], outline[(i + 1) % n], outline[(i + 2) % n]})) <= 0)
            return false;
    return true;
}

/// Closed in the sense of Euler: V - E + F = 2.
bool isClosed(const std::vector<Outline>& outlines) {
    std::vector<std::int32_t> corners;
    for (const Outline& outline : outlines) corners.insert(corners.end(), outline.begin(), outline.end());
    const std::size_t twice_edges = corners.size();
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return 2 * corners.size() + 2 * outlines.size() == twice_edges + 4;
}

}  // namespace

std::vector<Outline> mergeFacets(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                                 double flatness) {
    constexpr int kAttempts = 6;
    Surface surface{points, triangles, mapEdges(triangles), {}};
    for (int attempt = 0; attempt < kAttempts; ++attempt, flatness *= 0.1) {
        growRegions(surface, flatness);
        auto outlines = regionOutlines(surface);
        dropCollinear(outlines, points.size());
        const auto convex = [&](const Outline& outline) { return isConvex(points, outline); };
        if (outlines.size() >= 4 && std::all_of(outlines.begin(), outlines.end(), convex) &&
            isClosed(outlines))
            return outlines;
    }
    std::vector<Outline> outlines;
    for (const Triangle& t : triangles) outlines.emplace_back(t.begin(), t.end());
    return outlines;
}

}  // namespace talus
