#include "report/wet_outlines.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace talus::tools {

namespace {

using Outline = std::vector<Vec3>;

/// Against gravity: as it pulls, turned about y by the tilt.
Vec3 upOf(const Gravity& gravity) {
    const Vec3 up = gravity.direction ? Vec3(-gravity.direction->normalized()) : Vec3(Vec3::UnitZ());
    const double c = std::cos(gravity.tilt), s = std::sin(gravity.tilt);
    return {c * up.x() + s * up.z(), up.y(), c * up.z() - s * up.x()};
}

Outline outlineOf(const Model& model, const WetFace& wall) {
    const Polyhedron& shape = model.blocks[static_cast<std::size_t>(wall.block)].shape;
    Outline outline;
    for (const std::int32_t v : shape.faces[static_cast<std::size_t>(wall.face)])
        outline.push_back(shape.vertices[static_cast<std::size_t>(v)]);
    return outline;
}

/// The part of a polygon with normal . x <= offset.
Outline below(const Outline& outline, const Vec3& normal, double offset) {
    Outline part;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec3 &a = outline[k], &b = outline[(k + 1) % outline.size()];
        const double at_a = normal.dot(a) - offset, at_b = normal.dot(b) - offset;
        if (at_a <= 0) part.push_back(a);
        if ((at_a <= 0) != (at_b <= 0)) part.push_back(a + (b - a) * (at_a / (at_a - at_b)));
    }
    return part;
}

/// The part of a polygon in a convex one of the same plane, or all of it where that is empty.
Outline within(Outline polygon, const Outline& fissure) {
    if (fissure.empty()) return polygon;
    Vec3 normal = Vec3::Zero();
    for (std::size_t k = 2; k < fissure.size(); ++k)
        normal += (fissure[k - 1] - fissure[0]).cross(fissure[k] - fissure[0]);
    for (std::size_t k = 0; k < fissure.size(); ++k) {
        const Vec3 out = (fissure[(k + 1) % fissure.size()] - fissure[k]).cross(normal);
        polygon = below(polygon, out, out.dot(fissure[k]));
    }
    return polygon;
}

/// Height of the table along `up`: of a depth, which counts along the wall's steepest line from the lowest
/// wet point.
double tableOf(const Model& model, const Water& water, const std::vector<Outline>& walls, const Vec3& up) {
    const double level = water.level.front().value;
    if (water.kind == Water::Level::elevation) return level;
    double lowest = kInfinity;
    for (const Outline& wall : walls)
        for (const Vec3& corner : wall) lowest = std::min(lowest, up.dot(corner));
    const WetFace& first = water.walls.front();
    const Vec3 normal = model.blocks[static_cast<std::size_t>(first.block)].shape.faceNormal(
        static_cast<std::size_t>(first.face));
    const double across = normal.dot(up);
    return lowest + level * std::sqrt(std::max(0.0, 1 - across * across));
}

void addWalls(const Model& model, const Water& water, const Vec3& up, std::vector<Outline>& outlines) {
    if (water.walls.empty() || water.level.empty()) return;
    std::vector<Outline> walls;
    for (const WetFace& wall : water.walls) {
        Outline outline = outlineOf(model, wall);
        outline = within(outline, water.outline);
        if (std::isfinite(water.base)) outline = below(outline, -Vec3::UnitZ(), -water.base);
        if (outline.size() > 2) walls.push_back(std::move(outline));
    }
    const double table = tableOf(model, water, walls, up);
    for (const Outline& wall : walls)
        if (Outline wet = below(wall, up, table); wet.size() > 2) outlines.push_back(std::move(wet));
}

}  // namespace

namespace {

std::vector<Outline> edgesOf(const TriangleSurface& mesh) {
    std::set<std::pair<std::int32_t, std::int32_t>> edges;
    for (const auto& corners : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) edges.insert(std::minmax(corners[k], corners[(k + 1) % 3]));
    std::vector<Outline> lines;
    for (const auto& [from, to] : edges)
        lines.push_back(
            {mesh.vertices[static_cast<std::size_t>(from)], mesh.vertices[static_cast<std::size_t>(to)]});
    return lines;
}

}  // namespace

std::vector<Outline> wetOutlines(const Model& model) {
    std::vector<Outline> outlines;
    const Vec3 up = upOf(model.gravity);
    for (const Water& water : model.waters) addWalls(model, water, up, outlines);
    return outlines;
}

std::vector<Outline> waterTable(const Model& model) {
    if (!model.phreatic) return {};
    if (!model.phreatic->mesh.triangles.empty()) return edgesOf(model.phreatic->mesh);
    Vec3 low = Vec3::Constant(kInfinity), high = -low;
    for (const Block& block : model.blocks)
        for (const Vec3& v : block.shape.vertices) {
            low = low.cwiseMin(v);
            high = high.cwiseMax(v);
        }
    auto line = model.phreatic->line;
    if (line.front().x > low.x()) line.insert(line.begin(), {low.x(), line.front().z});
    if (line.back().x < high.x()) line.push_back({high.x(), line.back().z});
    std::vector<Outline> lines(2);
    for (const auto& point : line) {
        lines[0].emplace_back(point.x, low.y(), point.z);
        lines[1].emplace_back(point.x, high.y(), point.z);
    }
    return lines;
}

}  // namespace talus::tools
