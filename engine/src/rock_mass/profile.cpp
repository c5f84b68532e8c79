// Surfaces made from boxes and slope profiles.

#include <algorithm>
#include <cmath>

#include "rock_mass/place_text.h"
#include "rock_mass/plane_polygon.h"
#include "talus/surface.h"

namespace talus {

namespace {

using rock_mass::numberText;
using Point = rock_mass::PlanePoint;

std::vector<Error> profileErrors(const std::vector<Point>& p) {
    const std::size_t n = p.size();
    if (n < 3) return {{"", "found " + std::to_string(n) + " points, allowed: at least three"}};
    const auto field = [](std::size_t i) { return "[" + std::to_string(i) + "]"; };
    for (std::size_t i = 0; i < n; ++i) {
        if (!p[i].allFinite()) return {{field(i), "coordinates must be finite"}};
        if (p[i] == p[(i + 1) % n])
            return {{field((i + 1) % n),
                     "found the point of " + field(i) + " again, allowed: a point of its own"}};
    }
    const auto fault = rock_mass::polygonFault(p);
    if (!fault) return {};
    if (fault->turns_back)
        return {{field(fault->first),
                 "found a profile that turns back on itself, allowed: sides that do not touch"}};
    return {{field(fault->second), "found a side that meets the one behind point " + field(fault->first) +
                                       ", allowed: sides that do not cross or touch"}};
}

}  // namespace

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
        return Error{"y", "found " + numberText(y_min) + " to " + numberText(y_max) +
                              ", allowed: the smaller one first"};
    if (auto errors = profileErrors(profile); !errors.empty()) return errors;
    std::vector<Point> p = profile;
    if (rock_mass::doubleArea(p) < 0) std::reverse(p.begin(), p.end());
    const auto caps = rock_mass::triangulate(p);
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
