#include "geometry/thickness.h"

#include <doctest/doctest.h>

#include "engine/geometry/random_shapes.h"
#include "support/bodies.h"
#include "talus/model.h"

using namespace talus;
using namespace talus::test;

namespace {

/// From wherever on its surface, in a body that is turned and has been moved.
double thicknessOf(const Polyhedron& shape, const Vec3& surface, const Vec3& inwards, double enough = 100) {
    const std::vector<FacePlane> planes = facePlanes(shape);
    const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Vec3 position(10, -20, 30);
    double most = 0;
    for (std::size_t part = 0; part < shape.partCount(); ++part) {
        const PartOfBody body{shape, planes, part, turn, position, 1e-7};
        most =
            std::max(most, thicknessAt(body, position + turn * surface, turn * inwards.normalized(), enough));
    }
    return most;
}

/// Of a box from a point of its surface.
double throughBox(const Vec3& low, const Vec3& high, const Vec3& surface, const Vec3& inwards) {
    const Vec3 direction = inwards.normalized();
    double end = kInfinity;
    for (int axis = 0; axis < 3; ++axis) {
        const double wall = direction[axis] > 0 ? high[axis] : low[axis];
        end = std::min(end, (wall - surface[axis]) / direction[axis]);
    }
    return end;
}

}  // namespace

TEST_SUITE("geometry") {
    TEST_CASE("thicknessAt: of an angle its foot, its upright, and both where one stands on the other") {
        const Polyhedron shape = bodyOf(angle());  // foot 1 x 0.4 x 0.2, upright 0.2 x 0.4 x 0.6 on its end
        constexpr double kNear = 1e-5;
        CHECK(thicknessOf(shape, {0.6, 0.1, 0.2}, {0, 0, -1}) == within(kNear, 0.2));
        CHECK(thicknessOf(shape, {0.1, 0.1, 0.8}, {0, 0, -1}) == within(kNear, 0.8));
        CHECK(thicknessOf(shape, {0.0, 0.1, 0.6}, {1, 0, 0}) == within(kNear, 0.2));
        CHECK(thicknessOf(shape, {0.0, 0.1, 0.1}, {1, 0, 0}) == within(kNear, 1.0));
        CHECK(thicknessOf(shape, {0.6, 0.4, 0.1}, {0, -1, 0}) == within(kNear, 0.4));
        CHECK(thicknessOf(shape, {0.6, 0.1, 0.2}, {0, 0, 1}) == 0);                    // outwards
        CHECK(thicknessOf(shape, {0.6, 0.1, 0.5}, {0, 0, -1}) == 0);                   // beside the body
        CHECK(thicknessOf(shape, {0.6, 0.0, 0.2}, {0, 0, -1}) == within(kNear, 0.2));  // along a side
    }

    TEST_CASE("thicknessAt: a body cut in eight is as thick as whole, in any direction") {
        Random random(17);
        const Vec3 low(-1, 2, 3), high(1, 2.7, 3.4);
        const Polyhedron cut = inEight(low, high);
        for (int trial = 0; trial < 200; ++trial) {
            Vec3 surface;
            for (int axis = 0; axis < 3; ++axis) surface[axis] = random.uniform(low[axis], high[axis]);
            const int side = random.integer(0, 2);
            surface[side] = trial % 2 == 0 ? low[side] : high[side];
            Vec3 inwards = random.direction();
            inwards[side] = (trial % 2 == 0 ? 1 : -1) * (0.2 + std::abs(inwards[side]));
            const double expected = throughBox(low, high, surface, inwards);
            CHECK(expected > 0);
            CHECK(thicknessOf(cut, surface, inwards) == within(1e-4, expected));
            CHECK(thicknessOf(cut, surface, inwards, 0.5 * expected) >= 0.5 * expected);
        }
    }
}
