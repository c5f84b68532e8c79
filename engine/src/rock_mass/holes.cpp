#include "rock_mass/holes.h"

#include <algorithm>
#include <map>

#include "rock_mass/plane_polygon.h"
#include "rock_mass/surface_faults.h"

namespace talus::rock_mass {

namespace {

const Vec3& at(const TriangleSurface& surface, std::int32_t vertex) {
    return surface.vertices[static_cast<std::size_t>(vertex)];
}

}  // namespace

std::vector<Outline> openOutlines(const TriangleSurface& surface) {
    std::multimap<std::int32_t, std::int32_t> leaving;
    for (const OpenEdge& edge : openEdges(surface)) leaving.emplace(edge.from, edge.to);
    std::vector<Outline> outlines;
    while (!leaving.empty()) {
        Outline walk{leaving.begin()->first};
        std::map<std::int32_t, std::size_t> place{{walk[0], 0}};  // of the corners of the walk
        for (auto edge = leaving.begin(); edge != leaving.end(); edge = leaving.find(walk.back())) {
            const std::int32_t next = edge->second;
            leaving.erase(edge);
            const auto [known, is_new] = place.emplace(next, walk.size());
            if (is_new) {
                walk.push_back(next);
                continue;
            }
            const auto begin = walk.begin() + static_cast<std::ptrdiff_t>(known->second);
            outlines.emplace_back(begin, walk.end());
            for (auto v = begin + 1; v != walk.end(); ++v) place.erase(*v);
            walk.erase(begin + 1, walk.end());
        }
    }
    return outlines;
}

Vec3 areaVectorOf(const Outline& outline, const TriangleSurface& surface) {
    const Vec3& first = at(surface, outline[0]);
    Vec3 twice = Vec3::Zero();
    for (std::size_t i = 2; i < outline.size(); ++i)
        twice += (at(surface, outline[i - 1]) - first).cross(at(surface, outline[i]) - first);
    // The triangles beside a hole run along it the other way than those that close it.
    return -0.5 * twice;
}

SurfaceHole holeOf(const Outline& outline, const TriangleSurface& surface) {
    SurfaceHole hole;
    Vec3 low = at(surface, outline[0]), high = low;
    for (const std::int32_t v : outline) {
        hole.middle += at(surface, v) / static_cast<double>(outline.size());
        low = low.cwiseMin(at(surface, v));
        high = high.cwiseMax(at(surface, v));
    }
    hole.edges = outline.size();
    hole.width = (high - low).maxCoeff();
    return hole;
}

std::vector<std::array<std::int32_t, 3>> lidOf(const Outline& outline, const TriangleSurface& surface) {
    if (outline.size() < 3) return {};
    Outline lid(outline.rbegin(), outline.rend());
    const Vec3 area = areaVectorOf(outline, surface);
    if (!(area.norm() > 0)) return {};
    const Vec3 normal = area.normalized();
    const Vec3 right = normal.unitOrthogonal(), up = normal.cross(right);
    std::vector<PlanePoint> seen;
    for (const std::int32_t v : lid) seen.emplace_back(at(surface, v).dot(right), at(surface, v).dot(up));
    for (std::size_t i = 0; i < seen.size(); ++i)
        if (seen[i] == seen[(i + 1) % seen.size()]) return {};
    if (polygonFault(seen)) return {};
    auto triangles = triangulate(seen);
    for (auto& triangle : triangles)
        for (std::int32_t& corner : triangle) corner = lid[static_cast<std::size_t>(corner)];
    return triangles;
}

}  // namespace talus::rock_mass
