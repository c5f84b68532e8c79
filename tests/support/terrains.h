#pragma once
// Open terrains: a family of forms over a grid, with heights of few digits, so that no shift rounds them.

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "talus/rock_mass.h"

namespace talus::test {

enum class Ground { hill, ridge, benches, rough };
inline constexpr Ground kGrounds[]{Ground::hill, Ground::ridge, Ground::benches, Ground::rough};

/// Heights of (n + 1)^2 points, 2 m apart, row by row from the south.
inline std::vector<double> heights(Ground ground, int n) {
    std::mt19937_64 random(17);
    std::uniform_real_distribution<> noise(0, 0.8);
    const double middle = n;
    std::vector<double> all;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double x = 2 * i, y = 2 * j;
            double z = 0.3 * x;
            if (ground == Ground::hill)
                z = 0.2 * x + 3 * std::exp(-((x - middle) * (x - middle) + (y - middle) * (y - middle)) / 40);
            if (ground == Ground::ridge) z += 2 - 0.4 * std::abs(y - middle);
            if (ground == Ground::benches) z = 2 * std::floor(x / 6) + y / 64;
            if (ground == Ground::rough) z += noise(random);
            all.push_back(std::round(1024 * z) / 1024);
        }
    return all;
}

/// The terrain as the grid's reader divides it. \param origin  of its south-western corner
inline TriangleSurface terrainOf(const std::vector<double>& z, int n, const Vec3& origin = Vec3::Zero()) {
    TriangleSurface surface;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            surface.vertices.emplace_back(origin +
                                          Vec3(2 * i, 2 * j, z[static_cast<std::size_t>(j * (n + 1) + i)]));
    const auto height = [&](int v) { return z[static_cast<std::size_t>(v)]; };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int sw = j * (n + 1) + i, se = sw + 1, nw = sw + n + 1, ne = nw + 1;
            if (std::abs(height(sw) - height(ne)) <= std::abs(height(se) - height(nw))) {
                surface.triangles.push_back({sw, se, ne});
                surface.triangles.push_back({sw, ne, nw});
            } else {
                surface.triangles.push_back({sw, se, nw});
                surface.triangles.push_back({se, ne, nw});
            }
        }
    return surface;
}

inline TriangleSurface terrainOf(Ground ground, int n) { return terrainOf(heights(ground, n), n); }

/// Index of its first vertex nearest to a place in plan.
inline std::size_t vertexAt(const TriangleSurface& surface, double x, double y) {
    std::size_t best = 0;
    const auto distance = [&](std::size_t v) {
        return (surface.vertices[v].head<2>() - Eigen::Vector2d(x, y)).norm();
    };
    for (std::size_t v = 1; v < surface.vertices.size(); ++v)
        if (distance(v) < distance(best)) best = v;
    return best;
}

}  // namespace talus::test
