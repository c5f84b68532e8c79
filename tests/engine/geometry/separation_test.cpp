#include "geometry/separation.h"

#include <doctest/doctest.h>

#include <limits>

#include "engine/geometry/random_shapes.h"

using namespace talus;
using namespace talus::test;

namespace {

const Polyhedron kUnit = box({0, 0, 0}, {1, 1, 1});

/// Best of many random directions: never above the engine's answer, and close to it.
double bestOfDirections(const Polyhedron& a, const Polyhedron& b, Random& random, int count) {
    double best = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < count; ++i) {
        const Vec3 d = random.direction();
        double end_a = -1e300, start_b = 1e300;
        for (const Vec3& v : a.vertices) end_a = std::max(end_a, d.dot(v));
        for (const Vec3& v : b.vertices) start_b = std::min(start_b, d.dot(v));
        best = std::max(best, start_b - end_a);
    }
    return best;
}

}  // namespace

TEST_SUITE("geometry") {
    TEST_CASE("boxes apart, touching and overlapping, with the axis from the first to the second") {
        const auto apart = findSeparation(kUnit, box({1.25, 0, 0}, {2, 1, 1}));
        CHECK(apart.distance == within(1e-15, 0.25));
        CHECK((apart.axis - Vec3::UnitX()).norm() < 1e-15);
        const auto below = findSeparation(kUnit, box({0.2, 0.2, -3}, {0.8, 0.8, -0.5}));
        CHECK(below.distance == within(1e-15, 0.5));
        CHECK((below.axis + Vec3::UnitZ()).norm() < 1e-15);
        CHECK(separation(kUnit, box({0, 1, 0}, {1, 2, 1})) == 0);
        const auto deep = findSeparation(kUnit, box({0.5, 0.9, 0.3}, {2, 2, 2}));
        CHECK(deep.distance == within(1e-14, -0.1));
        CHECK((deep.axis - Vec3::UnitY()).norm() < 1e-15);
        CHECK(separation(kUnit, kUnit) == within(1e-15, -1));
    }

    TEST_CASE("a box turned by 45 degrees meets a face with its edge") {
        const Mat3 turn = Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitY()).toRotationMatrix();
        const Polyhedron edge =
            moved(box({-0.5, 0, -0.5}, {0.5, 1, 0.5}), turn, {0.5, 0, 1.01 + std::sqrt(0.5)});
        const auto found = findSeparation(kUnit, edge);
        CHECK(found.distance == within(1e-12, 0.01));
        CHECK((found.axis - Vec3::UnitZ()).norm() < 1e-12);
    }

    TEST_CASE("only their common normal separates two crossed edges") {
        // Two boxes standing on edge, one above the other, their edges at right angles: no face normal
        // separates them.
        const double half = std::sqrt(0.5);
        const Polyhedron centred = box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
        const auto roof = Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitX()).toRotationMatrix();
        const auto keel = Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitY()).toRotationMatrix();
        for (const double gap : {0.02, -0.02}) {
            const auto found = findSeparation(moved(centred, roof, Vec3::Zero()),
                                              moved(centred, keel, {0.1, -0.1, 2 * half + gap}));
            CHECK(found.distance == within(1e-12, gap));
            CHECK((found.axis - Vec3::UnitZ()).norm() < 1e-12);
        }
    }

    TEST_CASE("random polyhedra: no direction separates them better, and moving by it makes them touch") {
        Random random(41);
        int overlapping = 0;
        for (int trial = 0; trial < 40; ++trial) {
            const Polyhedron a = randomPolyhedron(random, 8);
            const Polyhedron b = moved(randomPolyhedron(random, 8), random.rotation(), random.inBox(1));
            const auto found = findSeparation(a, b);
            const auto back = findSeparation(b, a);
            CHECK(back.distance == within(1e-12, found.distance));
            CHECK(found.axis.norm() == within(1e-14, 1));
            if (found.distance > 0) continue;
            ++overlapping;
            const double sampled = bestOfDirections(a, b, random, 4000);
            CHECK(sampled <= found.distance + 1e-12);
            CHECK(sampled > found.distance - 0.2);
            const Polyhedron parted = moved(b, Mat3::Identity(), -found.distance * found.axis);
            CHECK(std::abs(separation(a, parted)) < 1e-12);
        }
        CHECK(overlapping > 20);
    }

    TEST_CASE("the same far from the origin, to the rounding of the coordinates") {
        const Vec3 shift(1000, 1000, -1000);
        const Polyhedron a = box({0, 0, 0}, {0.1, 0.1, 0.1}), b = box({0.02, 0.03, 0.1}, {0.12, 0.2, 0.2});
        CHECK(std::abs(separation(moved(a, Mat3::Identity(), shift), moved(b, Mat3::Identity(), shift))) <
              1e-12);
    }

    TEST_CASE("the search ends early when an axis is enough, and still reports a true separation") {
        const Polyhedron above = box({0.5, 0.5, 1.5}, {2, 2, 2});
        const auto found = findSeparation(kUnit, above, 0.1);
        CHECK(found.distance >= 0.1);
        CHECK(found.distance <= separation(kUnit, above));
        CHECK(findSeparation(kUnit, kUnit, -0.5).distance == within(1e-15, -1));
    }
}
