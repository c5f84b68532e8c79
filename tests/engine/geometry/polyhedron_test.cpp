#include "talus/polyhedron.h"

#include <doctest/doctest.h>

#include <limits>

#include "engine/geometry/random_shapes.h"

using namespace talus;
using namespace talus::test;

TEST_SUITE("geometry") {
    TEST_CASE("a box has six outward faces in a fixed order") {
        const Polyhedron shape = box({1, 2, 3}, {2, 4, 6});
        REQUIRE(shape.vertices.size() == 8);
        REQUIRE(shape.faces.size() == 6);
        const Vec3 middle(1.5, 3, 4.5);
        for (std::size_t f = 0; f < 6; ++f) {
            const Vec3 expected = Vec3::Unit(static_cast<int>(f / 2)) * (f % 2 == 0 ? -1 : 1);
            CHECK((shape.faceNormal(f) - expected).norm() < 1e-15);
            const double half = Vec3(0.5, 1, 1.5)[static_cast<int>(f / 2)];
            CHECK((shape.faceCentroid(f) - middle - half * expected).norm() < 1e-15);
        }
        CHECK(shape.faceArea(0) == within(1e-15, 6));
        CHECK(shape.faceArea(2) == within(1e-15, 3));
        CHECK(shape.faceArea(5) == within(1e-15, 2));
    }

    TEST_CASE("a box that is not one is refused, with the axis named") {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        const auto flat = makeBox({0, 1, 0}, {1, 1, 1});
        REQUIRE_FALSE(flat.ok());
        REQUIRE(flat.errors().size() == 1);
        CHECK(flat.errors()[0].message == "min y = 1, max y = 1; min must be below max");
        const auto two = makeBox({0, 2, nan}, {1, 1, 1});
        REQUIRE_FALSE(two.ok());
        REQUIRE(two.errors().size() == 2);
        CHECK(two.errors()[1].message.find("max z = 1; both must be finite") != std::string::npos);
        CHECK_FALSE(makeBox({0, 0, 0}, {std::numeric_limits<double>::infinity(), 1, 1}).ok());
    }

    TEST_CASE("face quantities of a triangular face match the closed form") {
        const Polyhedron shape = *convexHull({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {0, 0, 5}});
        double surface = 0;
        Vec3 closed = Vec3::Zero();
        for (std::size_t f = 0; f < shape.faces.size(); ++f) {
            surface += shape.faceArea(f);
            closed += shape.faceArea(f) * shape.faceNormal(f);
        }
        const double slanted = 0.5 * std::sqrt(12.0 * 12 + 15 * 15 + 20 * 20);
        CHECK(surface == within(1e-14, 6 + 7.5 + 10 + slanted));
        CHECK(closed.norm() < 1e-14);
    }

    TEST_CASE("face quantities keep their accuracy a thousand block sizes away") {
        Random random(7);
        const Vec3 shift(1000, -1000, 1000);
        for (int trial = 0; trial < 50; ++trial) {
            Polyhedron shape = randomPolyhedron(random, 12);
            for (Vec3& v : shape.vertices) v *= 0.1;
            const Polyhedron far = moved(shape, Mat3::Identity(), shift);
            for (std::size_t f = 0; f < shape.faces.size(); ++f) {
                if (shape.faceArea(f) < 1e-3)
                    continue;  // of a small face the coordinates are known too badly
                CHECK((far.faceNormal(f) - shape.faceNormal(f)).norm() < 1e-10);
                CHECK(far.faceArea(f) == within(1e-10, shape.faceArea(f)));
                CHECK((far.faceCentroid(f) - shift - shape.faceCentroid(f)).norm() < 1e-12);
            }
        }
    }
}
