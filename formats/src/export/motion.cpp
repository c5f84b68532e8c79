// Where the blocks of a light frame are, and how they move.

#include <algorithm>

#include "export/placed.h"
#include "talus/motion_roles.h"

namespace talus::formats {
namespace {

Mat3 turnOf(const Vec3& rotation) {
    const double angle = rotation.norm();
    return angle > 0 ? Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix() : Mat3(Mat3::Identity());
}

double radiusOf(const RunGeometry& geometry, std::size_t b) {
    double radius = 0;
    for (auto v = geometry.vertex_begin[b]; v < geometry.vertex_begin[b + 1]; ++v)
        radius = std::max(
            radius, (at(geometry.vertex, static_cast<std::size_t>(v)) - at(geometry.centroid, b)).norm());
    return radius;
}

}  // namespace

std::vector<FailureMode> failureRoles(const SnapshotHeader& header, const LightFrame& frame) {
    if (header.failure) return header.failure->roles;
    const RunGeometry& g = header.geometry;
    std::vector<BlockDisplacement> displacements(header.names.size());
    double smallest = kInfinity;
    for (std::size_t b = 0; b < displacements.size(); ++b) {
        displacements[b].free = header.motions[b] == Motion::free;
        if (!displacements[b].free) continue;
        displacements[b].position = at(g.centroid, b) + at(frame.displacement, b);
        displacements[b].radius = radiusOf(g, b);
        displacements[b].translation = at(frame.displacement, b).norm();
        displacements[b].rotation = at(frame.rotation, b).norm();
        smallest = std::min(smallest, g.size[b]);
    }
    return motionRoles(displacements, MotionRule::kDeflectionOfSize * smallest);
}

std::vector<Vec3> placedVertices(const SnapshotHeader& header, const LightFrame& frame) {
    const RunGeometry& g = header.geometry;
    std::vector<Vec3> vertices(g.vertex.x.size());
    for (std::size_t b = 0; b < header.names.size(); ++b) {
        const Mat3 turn = turnOf(at(frame.rotation, b));
        const Vec3 centroid = at(g.centroid, b), moved = centroid + at(frame.displacement, b);
        for (auto v = static_cast<std::size_t>(g.vertex_begin[b]);
             v < static_cast<std::size_t>(g.vertex_begin[b + 1]); ++v)
            vertices[v] = moved + turn * (at(g.vertex, v) - centroid);
    }
    return vertices;
}

}  // namespace talus::formats
