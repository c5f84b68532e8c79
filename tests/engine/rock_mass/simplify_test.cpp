// Simplified surfaces: how far they are from the first, both ways, by brute force.

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "support/properties.h"
#include "support/terrains.h"

using namespace talus;
using namespace talus::test;

namespace {

/// Nearest point of a triangle, by its corners, edges and inside (C. Ericson, Real-Time Collision Detection,
/// 2005).
double distanceTo(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto toSegment = [&](const Vec3& from, const Vec3& to) {
        const Vec3 along = to - from;
        return (p - from - std::clamp(along.dot(p - from) / along.squaredNorm(), 0.0, 1.0) * along).norm();
    };
    const Vec3 normal = (b - a).cross(c - a).normalized();
    const bool inside = normal.dot((b - a).cross(p - a)) >= 0 && normal.dot((c - b).cross(p - b)) >= 0 &&
                        normal.dot((a - c).cross(p - c)) >= 0;
    if (inside) return std::abs(normal.dot(p - a));
    return std::min({toSegment(a, b), toSegment(b, c), toSegment(c, a)});
}

double distanceTo(const Vec3& p, const TriangleSurface& surface) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : surface.triangles)
        nearest = std::min(nearest, distanceTo(p, surface.vertices[static_cast<std::size_t>(a)],
                                               surface.vertices[static_cast<std::size_t>(b)],
                                               surface.vertices[static_cast<std::size_t>(c)]));
    return nearest;
}

/// Of points all over one surface to the other one: corners, points of edges and inside.
double farthestFrom(const TriangleSurface& from, const TriangleSurface& to, int steps) {
    double farthest = 0;
    for (const auto& t : from.triangles)
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; i + j <= steps; ++j) {
                const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
                const Vec3 p = (1 - u - v) * from.vertices[static_cast<std::size_t>(t[0])] +
                               u * from.vertices[static_cast<std::size_t>(t[1])] +
                               v * from.vertices[static_cast<std::size_t>(t[2])];
                farthest = std::max(farthest, distanceTo(p, to));
            }
    return farthest;
}

}  // namespace

TEST_CASE(
    "simplify: no point of either surface is farther than stated from the other, and what can go is gone") {
    for (const Ground ground : kGrounds)
        for (const double deviation : {0.02, 0.2, 1.0}) {
            const TriangleSurface first = terrainOf(ground, 12);
            const TriangleSurface coarse = simplifySurface(first, deviation);
            CAPTURE(static_cast<int>(ground));
            CAPTURE(deviation);
            CAPTURE(coarse.triangles.size());
            CHECK(coarse.triangles.size() <= first.triangles.size());
            CHECK(farthestFrom(first, coarse, 4) <= deviation);
            CHECK(farthestFrom(coarse, first, 12) <= deviation);
            if (deviation == 1.0) CHECK(coarse.triangles.size() < first.triangles.size() / 3);
            const auto closed = closeTerrain(coarse, -5);
            REQUIRE(closed.ok());
            for (const auto& t : coarse.triangles) {
                const auto corner = [&](std::size_t k) {
                    return coarse.vertices[static_cast<std::size_t>(t[k])];
                };
                CHECK((corner(1) - corner(0)).cross(corner(2) - corner(0)).z() > 0);
            }
        }
}

TEST_CASE("simplify: a plane keeps two triangles, the outline in plan stays, closed surfaces stay closed") {
    std::vector<double> plane;
    for (int j = 0; j <= 10; ++j)
        for (int i = 0; i <= 10; ++i) plane.push_back(0.5 * i + 0.25 * j);
    CHECK(simplifySurface(terrainOf(plane, 10), 1e-9).triangles.size() == 2);
    for (const Ground ground : kGrounds) {
        const TriangleSurface coarse = simplifySurface(terrainOf(ground, 10), 0.5);
        double plan = 0;
        for (const auto& [a, b, c] : coarse.triangles) {
            const auto at = [&](std::int32_t v) { return coarse.vertices[static_cast<std::size_t>(v)]; };
            plan += 0.5 * (at(b) - at(a)).cross(at(c) - at(a)).z();
        }
        CHECK(plan == doctest::Approx(400).epsilon(1e-12));
        const TriangleSurface closed = closeTerrain(terrainOf(ground, 10), -5)->surface;
        const TriangleSurface body = simplifySurface(closed, 0.1);
        CHECK(checkSurface(body).empty());
        CHECK(body.triangles.size() < closed.triangles.size());
        CHECK(farthestFrom(closed, body, 3) <= 0.1);
        CHECK(farthestFrom(body, closed, 6) <= 0.1);
    }
}

TEST_CASE("property: whatever heights are drawn, the stated deviation holds both ways") {
    checkProperty("simplify", 30, [] {
        const int n = 6;
        std::vector<double> z;
        for (int k = 0; k < (n + 1) * (n + 1); ++k) z.push_back(*numberIn(-1, 1));
        const double deviation = *numberIn(0.05, 1.2);
        const TriangleSurface first = terrainOf(z, n), coarse = simplifySurface(first, deviation);
        RC_ASSERT(farthestFrom(first, coarse, 6) <= deviation);
        RC_ASSERT(farthestFrom(coarse, first, 10) <= deviation);
        RC_ASSERT(closeTerrain(coarse, -5).ok());
    });
}
