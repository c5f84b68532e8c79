#pragma once
// Seeded random shapes for the geometry tests.

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "geometry/polygon.h"
#include "geometry/world_shape.h"
#include "talus/polyhedron.h"

namespace talus::test {

/// Equal within a relative error. (doctest's own scale of 1 would make that an absolute error for small
/// numbers.)
inline doctest::Approx within(double relative, double expected) {
    return doctest::Approx(expected).epsilon(relative).scale(1e-30);
}

/// Numbers from a seed, the same with every standard library.
class Random {
 public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double uniform(double low, double high) { return low + (high - low) * (engine_() / 4294967296.0); }
    int integer(int low, int high) { return low + static_cast<int>(engine_() % (high - low + 1u)); }
    Vec3 inBox(double half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
    Vec3 direction() {
        for (;;) {
            const Vec3 v = inBox(1);
            if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
        }
    }
    Mat3 rotation() { return Eigen::AngleAxisd(uniform(-3, 3), direction()).toRotationMatrix(); }

 private:
    std::mt19937 engine_;
};

inline Polyhedron moved(Polyhedron shape, const Mat3& rotation, const Vec3& shift) {
    for (Vec3& v : shape.vertices) v = rotation * v + shift;
    return shape;
}

/// A polyhedron with its normals: owns what a WorldShape refers to.
struct Placed {
    Polyhedron shape;
    std::vector<Vec3> normals;

    explicit Placed(Polyhedron polyhedron) : shape(std::move(polyhedron)) {
        for (std::size_t f = 0; f < shape.faces.size(); ++f) normals.push_back(shape.faceNormal(f));
    }
    WorldShape world() const { return {shape.vertices, shape.faces, normals}; }
};

inline Polyhedron box(const Vec3& min, const Vec3& max) { return *makeBox(min, max); }

/// Upright prism over a regular polygon of `sides` with circumradius `radius`, from z = 0 to `height`.
inline Polyhedron prism(int sides, double radius, double height) {
    std::vector<Vec3> points;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        for (const double z : {0.0, height})
            points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    return *convexHull(points);
}

inline std::vector<Vec3> randomPoints(Random& random, int count) {
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) points.push_back(random.inBox(1));
    return points;
}

inline Polyhedron randomPolyhedron(Random& random, int points) {
    return *convexHull(randomPoints(random, points));
}

/// Points at random angles on an ellipse about `centre`: always convex.
inline Polygon randomPolygon(Random& random, int corners, double radius, const Vec2& centre) {
    std::vector<double> angles;
    const double step = 2 * std::numbers::pi / corners;
    for (int i = 0; i < corners; ++i) angles.push_back(step * (i + random.uniform(0.05, 0.95)));
    const double squash = random.uniform(0.3, 1);
    const Eigen::Rotation2Dd turn(random.uniform(0, 3));
    Polygon polygon;
    for (const double a : angles)
        polygon.push(centre + turn * Vec2(radius * std::cos(a), squash * radius * std::sin(a)));
    return polygon;
}

/// Whether a point is inside, by its side of every edge: the oracle of the clipping tests.
inline bool contains(const Polygon& polygon, const Vec2& point) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 edge = polygon.next(i) - polygon[i], to = point - polygon[i];
        if (edge.x() * to.y() - edge.y() * to.x() < 0) return false;
    }
    return !polygon.empty();
}

}  // namespace talus::test
