#include <doctest/doctest.h>

#include <cmath>

#include "engine/geometry/random_shapes.h"
#include "talus/polyhedron.h"

using namespace talus;
using namespace talus::test;

namespace {

/// Volume, first and second moments (about the model's origin).
struct Moments {
    double volume = 0;
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();

    void add(double weight, const Vec3& point) {
        volume += weight;
        first += weight * point;
        second += weight * point * point.transpose();
    }
    MassProperties properties() const {
        const Vec3 c = first / volume;
        const Mat3 s = second - volume * c * c.transpose();
        return {volume, c, s.trace() * Mat3::Identity() - s};
    }
};

/// Keast's four-point rule, exact for degree 2: another formula than the engine's. Faces are cut into
/// triangles as the engine cuts them, since a face may be bent by a millionth of the block.
Moments byQuadrature(const Polyhedron& shape) {
    Vec3 inside = Vec3::Zero();
    for (const Vec3& v : shape.vertices) inside += v / static_cast<double>(shape.vertices.size());
    const double far = 0.58541019662496852, near = 0.13819660112501050;
    Moments sum;
    for (const auto& face : shape.faces)
        for (std::size_t i = 2; i < face.size(); ++i) {
            const Vec3 corner[4] = {inside, shape.vertices[face[0]], shape.vertices[face[i - 1]],
                                    shape.vertices[face[i]]};
            Mat3 edges;
            edges << corner[1] - corner[0], corner[2] - corner[0], corner[3] - corner[0];
            const Vec3 total = corner[0] + corner[1] + corner[2] + corner[3];
            for (const Vec3& c : corner) sum.add(edges.determinant() / 24, near * total + (far - near) * c);
        }
    return sum;
}

bool isInside(const Polyhedron& shape, const Vec3& point) {
    for (std::size_t f = 0; f < shape.faces.size(); ++f)
        if (shape.faceNormal(f).dot(point - shape.vertices[shape.faces[f][0]]) > 0) return false;
    return true;
}

/// Midpoints of n^3 cubes over [-1, 1]^3.
Moments byVoxels(const Polyhedron& shape, int n) {
    const double side = 2.0 / n;
    Moments sum;
    for (int x = 0; x < n; ++x)
        for (int y = 0; y < n; ++y)
            for (int z = 0; z < n; ++z) {
                const Vec3 p = side * Vec3(x + 0.5, y + 0.5, z + 0.5) - Vec3::Ones();
                if (isInside(shape, p)) sum.add(side * side * side, p);
            }
    return sum;
}

void checkClose(const MassProperties& found, const MassProperties& expected, double relative) {
    CHECK(found.volume == within(relative, expected.volume));
    CHECK((found.centroid - expected.centroid).norm() < relative * std::cbrt(expected.volume));
    CHECK((found.inertia - expected.inertia).norm() < relative * expected.inertia.norm());
}

}  // namespace

TEST_SUITE("geometry") {
    TEST_CASE("box: V, centroid and V/12 (b^2 + c^2)") {
        const MassProperties p = massProperties(box({1, 2, 3}, {1.2, 2.1, 3.5}));
        const double v = 0.2 * 0.1 * 0.5;
        CHECK(p.volume == within(1e-14, v));
        CHECK((p.centroid - Vec3(1.1, 2.05, 3.25)).norm() < 1e-15);
        const Vec3 expected = v / 12 * Vec3(0.1 * 0.1 + 0.25, 0.04 + 0.25, 0.04 + 0.1 * 0.1);
        CHECK((p.inertia - Mat3(expected.asDiagonal())).norm() < 1e-14 * expected.norm());
    }

    TEST_CASE("regular tetrahedron: V = s^3 / (6 sqrt 2), I = V s^2 / 20") {
        const double s = 2 * std::sqrt(2.0);
        const MassProperties p =
            massProperties(*convexHull({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}));
        CHECK(p.volume == within(1e-14, s * s * s / (6 * std::sqrt(2.0))));
        CHECK(p.centroid.norm() < 1e-15);
        CHECK((p.inertia - Mat3::Identity() * p.volume * s * s / 20).norm() < 1e-14);
    }

    TEST_CASE("random polyhedra against an independent formula") {
        Random random(11);
        for (int trial = 0; trial < 100; ++trial) {
            const Polyhedron shape = randomPolyhedron(random, random.integer(4, 60));
            checkClose(massProperties(shape), byQuadrature(shape).properties(), 1e-11);
        }
    }

    TEST_CASE("a random polyhedron against voxels") {
        Random random(12);
        const Polyhedron shape = randomPolyhedron(random, 20);
        checkClose(massProperties(shape), byVoxels(shape, 80).properties(), 4e-3);
    }

    TEST_CASE("turning and moving a block turns and moves its properties") {
        Random random(13);
        for (int trial = 0; trial < 50; ++trial) {
            const Polyhedron shape = randomPolyhedron(random, 15);
            const MassProperties p = massProperties(shape);
            const Mat3 r = random.rotation();
            const Vec3 shift = random.inBox(10);
            checkClose(massProperties(moved(shape, r, shift)),
                       {p.volume, r * p.centroid + shift, r * p.inertia * r.transpose()}, 1e-12);
        }
    }

    TEST_CASE("a block of 0.1 m keeps its accuracy 1000 m from the origin") {
        Random random(14);
        for (int trial = 0; trial < 50; ++trial) {
            Polyhedron shape = randomPolyhedron(random, 15);
            for (Vec3& v : shape.vertices) v *= 0.1;
            // The coordinates a far block really has, moved back: rounding of the input is not the engine's
            // error.
            const Vec3 shift(1024, -1024, 1024);
            const Polyhedron far = moved(shape, Mat3::Identity(), shift);
            MassProperties expected = massProperties(moved(far, Mat3::Identity(), -shift));
            expected.centroid += shift;
            checkClose(massProperties(far), expected, 1e-11);
        }
    }
}
