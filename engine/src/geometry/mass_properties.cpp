// Volume integrals over a closed surface, as a sum of signed tetrahedra between an origin and the surface's
// triangles (F. Tonon, Explicit exact formulas for the 3-D tetrahedron inertia tensor, 2004).

#include <Eigen/Geometry>

#include "talus/polyhedron.h"

namespace talus {
namespace {

/// Moments of order 0, 1 and 2 of a volume.
struct VolumeMoments {
    double volume = 0;           ///< [m^3]
    Vec3 first = Vec3::Zero();   ///< integral of x [m^4]
    Mat3 second = Mat3::Zero();  ///< integral of x x^T [m^5]
};

/// Adds the tetrahedron (0, a, b, c); negative when the triangle is seen from its back. Exact: over a simplex
/// the integral of x x^T is V/20 (s s^T + sum of v v^T), s the sum of its vertices v.
void addTetrahedron(VolumeMoments& sum, const Vec3& a, const Vec3& b, const Vec3& c) {
    const double volume = a.dot(b.cross(c)) / 6.0;
    const Vec3 corners = a + b + c;
    sum.volume += volume;
    sum.first += volume / 4.0 * corners;
    sum.second += volume / 20.0 *
                  (corners * corners.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
}

/// The mean of the vertices: inside the block, so that all tetrahedra are positive and nothing cancels,
/// however far the block is from the model's origin.
Vec3 localOrigin(const Polyhedron& shape) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& vertex : shape.vertices) sum += vertex - shape.vertices[0];
    return shape.vertices[0] + sum / static_cast<double>(shape.vertices.size());
}

VolumeMoments momentsAbout(const Vec3& origin, const Polyhedron& shape) {
    VolumeMoments sum;
    for (const auto& outline : shape.faces) {
        const Vec3 a = shape.vertices[outline[0]] - origin;
        for (std::size_t i = 2; i < outline.size(); ++i)
            addTetrahedron(sum, a, shape.vertices[outline[i - 1]] - origin,
                           shape.vertices[outline[i]] - origin);
    }
    return sum;
}

}  // namespace

MassProperties massProperties(const Polyhedron& shape) {
    if (shape.vertices.empty()) return {};
    const Vec3 origin = localOrigin(shape);
    const VolumeMoments moments = momentsAbout(origin, shape);
    const Vec3 centroid = moments.first / moments.volume;
    const Mat3 central = moments.second - moments.volume * centroid * centroid.transpose();
    return {moments.volume, origin + centroid, central.trace() * Mat3::Identity() - central};
}

}  // namespace talus
