#include "forces/phreatic_folds.h"

#include <cstdio>

namespace talus::phreatic {
namespace {

std::optional<Error> foldedLine(const PhreaticSurface& surface, const Vec3& down) {
    const Vec3 across = acrossOf(down);
    for (std::size_t k = 0; k + 1 < surface.line.size(); ++k) {
        const PhreaticSurface::Point &from = surface.line[k], &to = surface.line[k + 1];
        if (across.dot(Vec3(to.x, 0, to.z) - Vec3(from.x, 0, from.z)) <= 0)
            return Error{surface.field + ".surface",
                         "seen along gravity the line folds back behind its point " + std::to_string(k + 1) +
                             "; allowed: points in order across the direction of gravity"};
    }
    return std::nullopt;
}

std::optional<Error> foldedMesh(const PhreaticSurface& surface, const Vec3& down) {
    const auto at = [&](std::int32_t v) { return surface.mesh.vertices[static_cast<std::size_t>(v)]; };
    for (const auto& [a, b, c] : surface.mesh.triangles)
        if ((at(b) - at(a)).cross(at(c) - at(a)).dot(down) >= 0)
            return Error{surface.field + ".obj", "seen along gravity the surface folds back at " +
                                                     placeText(at(a)) +
                                                     "; allowed: triangles that all face up"};
    return std::nullopt;
}

}  // namespace

Vec3 acrossOf(const Vec3& down) { return down.cross(Vec3::UnitY()).normalized(); }

std::string placeText(const Vec3& p) {
    char text[80];
    std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g)", p.x(), p.y(), p.z());
    return text;
}

std::optional<Error> foldedSurface(const PhreaticSurface& surface, const Vec3& down) {
    return surface.mesh.triangles.empty() ? foldedLine(surface, down) : foldedMesh(surface, down);
}

}  // namespace talus::phreatic
