// Hulls of whatever points are drawn, many of them on a coarse grid, so that they coincide, line up and lie
// in planes.

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "support/properties.h"
#include "talus/polyhedron.h"

using namespace talus;
using namespace talus::test;

namespace {

using Coordinates = std::vector<std::tuple<int, int, int>>;

rc::Gen<Coordinates> pointsOnGrid(int cells) {
    const auto number = rc::gen::inRange(0, cells + 1);
    return rc::gen::container<Coordinates>(rc::gen::tuple(number, number, number));
}

std::vector<Vec3> pointsOf(const Coordinates& drawn, double cell) {
    std::vector<Vec3> points;
    for (const auto& [x, y, z] : drawn) points.push_back(cell * Vec3(x, y, z));
    return points;
}

/// Whether points of whole coordinates lie in one plane: exact.
bool areFlat(const Coordinates& drawn) {
    if (drawn.size() < 4) return true;
    using Whole = Eigen::Matrix<long, 3, 1>;
    std::vector<Whole> ways;
    for (const auto& [x, y, z] : drawn)
        ways.push_back(Whole(x, y, z) -
                       Whole(std::get<0>(drawn[0]), std::get<1>(drawn[0]), std::get<2>(drawn[0])));
    for (const Whole& a : ways)
        for (const Whole& b : ways) {
            const Whole normal = a.cross(b);
            if (normal.isZero()) continue;
            return std::all_of(ways.begin(), ways.end(), [&](const Whole& c) { return normal.dot(c) == 0; });
        }
    return true;  // on one line
}

void assertHull(const std::vector<Vec3>& points, const Polyhedron& hull, double tolerance) {
    std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
    for (std::size_t f = 0; f < hull.faces.size(); ++f) {
        const auto& outline = hull.faces[f];
        const Vec3 normal = hull.faceNormal(f), &at = hull.vertices[static_cast<std::size_t>(outline[0])];
        RC_ASSERT(outline.size() >= 3U);
        RC_ASSERT(hull.faceArea(f) > 0);
        for (const std::int32_t v : outline)  // planar
            RC_ASSERT(std::abs(normal.dot(hull.vertices[static_cast<std::size_t>(v)] - at)) <= tolerance);
        for (const Vec3& x : points)
            RC_ASSERT(normal.dot(x - at) <= tolerance);  // outward, all points inside
        for (std::size_t k = 0; k < outline.size(); ++k)
            ++edges[{outline[k], outline[(k + 1) % outline.size()]}];
        for (std::size_t g = 0; g < f; ++g)  // merged
            RC_ASSERT((hull.faceNormal(g) - normal).norm() > 1e-9);
    }
    for (const auto& [edge, count] : edges)
        RC_ASSERT(count == 1 && edges.count({edge.second, edge.first}) == 1U);
    RC_ASSERT(hull.vertices.size() + hull.faces.size() == edges.size() / 2 + 2);  // Euler
    for (const Vec3& v : hull.vertices) RC_ASSERT(std::find(points.begin(), points.end(), v) != points.end());
}

}  // namespace

TEST_SUITE("geometry") {
    TEST_CASE(
        "property: a hull holds all points, its faces are plane, outward and merged, and Euler's sum is "
        "two") {
        int hulls = 0, flat = 0;
        for (const int cells : {2, 5, 1000})
            checkProperty("hull of points on a grid of " + std::to_string(cells) + " cells", 150, [&] {
                const Coordinates drawn = *pointsOnGrid(cells);
                const double cell = *numberIn(0.01, 1);
                const std::vector<Vec3> points = pointsOf(drawn, cell);
                const auto hull = convexHull(points);
                RC_ASSERT(hull.ok() != areFlat(drawn));
                ++(hull.ok() ? hulls : flat);
                if (hull.ok()) assertHull(points, *hull, 1e-9 * cell * cells);
            });
        CHECK(hulls > 200);
        CHECK(flat > 10);
    }

    TEST_CASE(
        "property: the hull of a hull is itself, and volume and centroid do not depend on the order of "
        "points") {
        checkProperty("hull of a hull", 150, [] {
            const Coordinates drawn =
                *rc::gen::suchThat(pointsOnGrid(6), [](const Coordinates& c) { return !areFlat(c); });
            std::vector<Vec3> points = pointsOf(drawn, 0.1);
            const Polyhedron hull = *convexHull(points), again = *convexHull(hull.vertices);
            RC_ASSERT(again.vertices.size() == hull.vertices.size());
            RC_ASSERT(again.faces.size() == hull.faces.size());
            std::reverse(points.begin(), points.end());
            const MassProperties one = massProperties(hull), other = massProperties(*convexHull(points));
            RC_ASSERT(one.volume > 0);
            RC_ASSERT(std::abs(one.volume - other.volume) < 1e-12);
            RC_ASSERT((one.centroid - other.centroid).norm() < 1e-9);
        });
    }
}
