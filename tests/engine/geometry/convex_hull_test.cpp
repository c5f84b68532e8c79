#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

#include "engine/geometry/random_shapes.h"
#include "talus/polyhedron.h"

using namespace talus;
using namespace talus::test;

namespace {

double highestAbove(const Polyhedron& shape, std::size_t face, const std::vector<Vec3>& points) {
    const Vec3 origin = shape.vertices[shape.faces[face][0]], normal = shape.faceNormal(face);
    double highest = -std::numeric_limits<double>::infinity();
    for (const Vec3& p : points) highest = std::max(highest, normal.dot(p - origin));
    return highest;
}

/// Every edge is met once in each direction, and V - E + F = 2.
bool isClosed(const Polyhedron& shape) {
    std::set<std::pair<int, int>> edges;
    for (const auto& f : shape.faces)
        for (std::size_t i = 0; i < f.size(); ++i)
            if (!edges.insert({f[i], f[(i + 1) % f.size()]}).second) return false;
    for (const auto& [from, to] : edges)
        if (!edges.count({to, from})) return false;
    return 2 * shape.vertices.size() + 2 * shape.faces.size() == edges.size() + 4;
}

/// Sine of the sharpest turn at a face's corner, seen from outside; positive for strictly convex outlines.
double leastTurn(const Polyhedron& shape) {
    double least = 1;
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
        const auto& face = shape.faces[f];
        const std::size_t n = face.size();
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3& b = shape.vertices[face[(i + 1) % n]];
            const Vec3 in = b - shape.vertices[face[i]], out = shape.vertices[face[(i + 2) % n]] - b;
            least = std::min(least, shape.faceNormal(f).dot(in.normalized().cross(out.normalized())));
        }
    }
    return least;
}

void checkHull(const Polyhedron& shape, const std::vector<Vec3>& points, double tolerance) {
    CHECK(isClosed(shape));
    CHECK(leastTurn(shape) > 0);
    for (std::size_t f = 0; f < shape.faces.size(); ++f) CHECK(highestAbove(shape, f, points) <= tolerance);
}

void shuffle(std::vector<Vec3>& points, Random& random) {
    for (std::size_t i = points.size(); i > 1; --i)
        std::swap(points[i - 1],
                  points[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
}

std::vector<Vec3> boxCorners(const Vec3& half) {
    std::vector<Vec3> corners;
    for (int c = 0; c < 8; ++c)
        corners.push_back(half.cwiseProduct(Vec3(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1)));
    return corners;
}

}  // namespace

TEST_SUITE("geometry") {
    TEST_CASE("the hull of random points holds them all, closed and convex") {
        Random random(1);
        for (int trial = 0; trial < 200; ++trial) {
            const auto points = randomPoints(random, random.integer(4, 80));
            const auto hull = convexHull(points);
            REQUIRE(hull.ok());
            checkHull(*hull, points, 4e-6);
        }
    }

    TEST_CASE("points on a sphere are all vertices") {
        Random random(2);
        for (const int count : {20, 100, 400}) {
            std::vector<Vec3> points;
            for (int i = 0; i < count; ++i) points.push_back(random.direction());
            const auto hull = convexHull(points);
            REQUIRE(hull.ok());
            CHECK(hull->vertices.size() == points.size());
            checkHull(*hull, points, 4e-6);
        }
    }

    TEST_CASE("a face of the hull is the plane of three points with all others below: brute force") {
        Random random(3);
        for (int trial = 0; trial < 20; ++trial) {
            const auto points = randomPoints(random, 14);
            const Polyhedron hull = *convexHull(points);
            std::size_t facets = 0;
            for (std::size_t a = 0; a < points.size(); ++a)
                for (std::size_t b = 0; b < points.size(); ++b)
                    for (std::size_t c = 0; c < points.size(); ++c) {
                        if (a == b || b == c || a == c) continue;
                        const Vec3 normal = (points[b] - points[a]).cross(points[c] - points[a]).normalized();
                        const auto below = [&](const Vec3& p) { return normal.dot(p - points[a]) < 1e-12; };
                        facets += std::all_of(points.begin(), points.end(), below);
                    }
            CHECK(facets == 3 * hull.faces.size());  // each triangle is found from each of its corners
        }
    }

    TEST_CASE("a cube with points on its edges, in its faces and inside has six faces and eight vertices") {
        Random random(4);
        for (int trial = 0; trial < 100; ++trial) {
            const Vec3 half(random.uniform(0.05, 1), random.uniform(0.05, 1), random.uniform(0.05, 1));
            const auto corners = boxCorners(half);
            auto points = corners;
            for (int i = 0; i < 60; ++i) {
                Vec3 p = random.inBox(1).cwiseProduct(half);
                for (int axis = 0; axis < i % 3; ++axis)
                    p[axis] = random.integer(0, 1) ? half[axis] : -half[axis];
                points.push_back(p);
            }
            points.insert(points.end(), corners.begin(), corners.end());  // twice
            const Mat3 turn = random.rotation();
            const Vec3 shift = trial % 2 ? Vec3(random.inBox(1000)) : Vec3::Zero();
            for (Vec3& p : points) p = turn * p + shift;
            shuffle(points, random);
            const auto hull = convexHull(points);
            REQUIRE(hull.ok());
            CHECK(hull->vertices.size() == 8);
            CHECK(hull->faces.size() == 6);
            checkHull(*hull, points, 1e-8);
        }
    }

    TEST_CASE("the result does not depend on the order of the points") {
        Random random(5);
        for (int trial = 0; trial < 30; ++trial) {
            auto points = trial % 2 ? randomPoints(random, 40) : boxCorners(Vec3(1, 2, 3));
            const Polyhedron first = *convexHull(points);
            shuffle(points, random);
            const Polyhedron second = *convexHull(points);
            CHECK(first.vertices == second.vertices);
            CHECK(first.faces == second.faces);
        }
    }

    TEST_CASE("a regular lattice of points, all of them degenerate, is a cube") {
        std::vector<Vec3> points;
        for (int x = 0; x < 6; ++x)
            for (int y = 0; y < 6; ++y)
                for (int z = 0; z < 6; ++z) points.emplace_back(0.1 * x, 0.1 * y, 0.1 * z);
        const auto hull = convexHull(points);
        REQUIRE(hull.ok());
        CHECK(hull->vertices == box({0, 0, 0}, {0.5, 0.5, 0.5}).vertices);
        CHECK(hull->faces.size() == 6);
    }

    TEST_CASE("prisms keep their polygons") {
        for (const int sides : {3, 5, 6, 12, 60, 150}) {
            const Polyhedron shape = prism(sides, 0.3, 0.1);
            CHECK(shape.faces.size() == static_cast<std::size_t>(sides + 2));
            CHECK(shape.vertices.size() == static_cast<std::size_t>(2 * sides));
            checkHull(shape, shape.vertices, 1e-9);
        }
    }

    TEST_CASE("coordinates written with seven digits, or a slightly bent face, still give six faces") {
        Random random(6);
        for (int trial = 0; trial < 200; ++trial) {
            auto points = boxCorners(Vec3(0.5, 0.3, 0.2));
            const Mat3 turn = random.rotation();
            for (Vec3& p : points) p = turn * p + random.inBox(1e-7);
            const auto hull = convexHull(points);
            REQUIRE(hull.ok());
            CHECK(hull->faces.size() == 6);
            checkHull(*hull, points, 1e-5);
        }
    }

    TEST_CASE("noise of the size of the tolerances never breaks the topology") {
        Random random(8);
        for (int trial = 0; trial < 1000; ++trial) {
            auto points = boxCorners(Vec3(0.5, 0.3, 0.2));
            for (int i = 0; i < 12; ++i) {
                Vec3 p = points[static_cast<std::size_t>(i % 8)];
                p[i % 3] = random.uniform(-1, 1) * p[i % 3];
                points.push_back(p);
            }
            const double noise = std::pow(10, random.uniform(-12, -3));
            const Mat3 turn = random.rotation();
            for (Vec3& p : points) p = turn * p + random.inBox(noise);
            const auto hull = convexHull(points);
            REQUIRE(hull.ok());
            CHECK(isClosed(*hull));
            CHECK(leastTurn(*hull) > 0);
            CHECK(massProperties(*hull).volume == within(20 * noise + 1e-5, 0.24));
        }
    }

    TEST_CASE("what has no volume is refused") {
        CHECK(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).errors()[0].message ==
              "3 points; at least four are needed");
        CHECK(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, -0.0}}).errors()[0].message ==
              "3 different points; at least four are needed");
        CHECK_FALSE(convexHull({}).ok());
        const std::vector<Vec3> same(5, Vec3(1, 2, 3));
        CHECK_FALSE(convexHull(same).ok());
        const auto line = convexHull({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}});
        REQUIRE_FALSE(line.ok());
        CHECK(line.errors()[0].message.find("on one line") != std::string::npos);
        Random random(9);
        std::vector<Vec3> flat;
        const Mat3 turn = random.rotation();
        for (int i = 0; i < 20; ++i)
            flat.push_back(turn * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0.1));
        REQUIRE_FALSE(convexHull(flat).ok());
        CHECK(convexHull(flat).errors()[0].message.find("in one plane") != std::string::npos);
        auto holed = boxCorners(Vec3(1, 1, 1));
        holed[3].y() = std::numeric_limits<double>::quiet_NaN();
        REQUIRE_FALSE(convexHull(holed).ok());
        CHECK(convexHull(holed).errors()[0].field == "vertices[3]");
        holed[3].y() = std::numeric_limits<double>::infinity();
        CHECK_FALSE(convexHull(holed).ok());
        holed[3].y() = 1.7e308, holed[4].y() = -1.7e308;
        CHECK_FALSE(convexHull(holed).ok());
    }

    TEST_CASE("a thin plate keeps both its sides") {
        const Polyhedron plate = *convexHull(boxCorners(Vec3(1, 1, 1e-5)));
        CHECK(plate.faces.size() == 6);
        CHECK(massProperties(plate).volume == within(1e-12, 8e-5));
    }
}
