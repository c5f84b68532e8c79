// Where the blocks of a light frame are, and how they move.

#include <algorithm>

#include "export/placed.h"

namespace talus::formats {
namespace {

constexpr double kMovingShare = 0.1;     // of the farthest block's way
constexpr double kTopplingShare = 0.25;  // rotation times the moving group's extent, over the motion

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
    const std::size_t n = header.names.size();
    std::vector<double> motion(n, 0.0), radius(n, 0.0);
    for (std::size_t b = 0; b < n; ++b) {
        if (header.motions[b] != Motion::free) continue;
        radius[b] = radiusOf(g, b);
        motion[b] = at(frame.displacement, b).norm() + at(frame.rotation, b).norm() * radius[b];
    }
    const double farthest = n > 0 ? *std::max_element(motion.begin(), motion.end()) : 0.0;
    const auto moves = [&](std::size_t b) { return motion[b] > kMovingShare * farthest; };
    Vec3 low = Vec3::Constant(kInfinity), high = Vec3::Constant(-kInfinity);
    for (std::size_t b = 0; b < n; ++b) {
        if (!moves(b)) continue;
        const Vec3 position = at(g.centroid, b) + at(frame.displacement, b);
        low = low.cwiseMin(position - Vec3::Constant(radius[b]));
        high = high.cwiseMax(position + Vec3::Constant(radius[b]));
    }
    const double extent = (high - low).norm();
    std::vector<FailureMode> roles(n, FailureMode::none);
    for (std::size_t b = 0; b < n; ++b)
        if (moves(b))
            roles[b] = at(frame.rotation, b).norm() * extent > kTopplingShare * motion[b]
                           ? FailureMode::toppling
                           : FailureMode::sliding;
    return roles;
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
