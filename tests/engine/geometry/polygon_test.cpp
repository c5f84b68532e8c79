#include "geometry/polygon.h"

#include <doctest/doctest.h>

#include "engine/geometry/random_shapes.h"

using namespace talus;
using namespace talus::test;

namespace {

/// Area by counting midpoints of an n x n grid over [-half, half]^2.
template <class Inside>
double countedArea(double half, int n, Inside inside) {
    const double side = 2 * half / n;
    int hits = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) hits += inside(Vec2(-half + side * (i + 0.5), -half + side * (j + 0.5)));
    return hits * side * side;
}

double leastTurn(const Polygon& p) {
    double least = 1;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec2 in = p.next(i) - p[i], out = p.next((i + 1) % p.size()) - p.next(i);
        least = std::min(least, (in.x() * out.y() - in.y() * out.x()) / in.norm() / out.norm());
    }
    return least;
}

Polygon rectangle(double x0, double y0, double x1, double y1) {
    return {Vec2(x0, y0), Vec2(x1, y0), Vec2(x1, y1), Vec2(x0, y1)};
}

Polygon turned(const Polygon& polygon, double angle) {
    Polygon result;
    for (const Vec2& p : polygon) result.push(Eigen::Rotation2Dd(angle) * p);
    return result;
}

}  // namespace

TEST_SUITE("geometry") {
    TEST_CASE("area, centroid and second moments of a rectangle match the closed form") {
        const Polygon p = rectangle(1, 2, 1.2, 2.5);
        CHECK(area(p) == within(1e-14, 0.1));
        CHECK((centroid(p) - Vec2(1.1, 2.25)).norm() < 1e-15);
        const SecondMoments m = secondMoments(p);
        CHECK(m.xx == within(1e-14, 0.5 * (1.2 * 1.2 * 1.2 - 1) / 3));
        CHECK(m.yy == within(1e-14, 0.2 * (2.5 * 2.5 * 2.5 - 8) / 3));
        CHECK(m.xy == within(1e-14, 0.1 * 1.1 * 2.25));
    }

    TEST_CASE("moments of random polygons: parts add up, and a turn turns them") {
        Random random(21);
        for (int trial = 0; trial < 100; ++trial) {
            const Polygon p = randomPolygon(random, random.integer(3, 12), 1, {0.3, -0.2});
            const Vec2 normal(random.uniform(-1, 1), random.uniform(-1, 1));
            const double offset = normal.dot(centroid(p));
            const Polygon one = clipHalfPlane(p, normal, offset), two = clipHalfPlane(p, -normal, -offset);
            CHECK(area(one) + area(two) == within(1e-13, area(p)));
            CHECK((area(one) * centroid(one) + area(two) * centroid(two) - area(p) * centroid(p)).norm() <
                  1e-13);
            const SecondMoments a = secondMoments(one), b = secondMoments(two), m = secondMoments(p);
            CHECK(a.xx + b.xx == within(1e-12, m.xx));
            CHECK(a.yy + b.yy == within(1e-12, m.yy));
            CHECK(std::abs(a.xy + b.xy - m.xy) < 1e-13);
            const SecondMoments quarter = secondMoments(turned(p, std::numbers::pi / 2));
            CHECK(quarter.xx == within(1e-12, m.yy));
            CHECK(std::abs(quarter.xy + m.xy) < 1e-13);
        }
    }

    TEST_CASE("intersections of random polygons against counting") {
        Random random(22);
        for (int trial = 0; trial < 60; ++trial) {
            const Polygon a = randomPolygon(random, random.integer(3, 9), 1, {0, 0});
            const Polygon b = randomPolygon(random, random.integer(3, 9), 0.8,
                                            {random.uniform(-1.5, 1.5), random.uniform(-1, 1)});
            const Polygon c = intersect(a, b);
            const auto inside = [&](const Vec2& p) { return contains(a, p) && contains(b, p); };
            CHECK(std::abs(area(c) - countedArea(2.5, 500, inside)) < 4e-3);
            CHECK(area(intersect(b, a)) == within(1e-12, area(c)));
            if (!c.empty()) CHECK(leastTurn(c) > 0);
            // A point common to both is in the result, and the other way round.
            for (int i = 0; i < 100; ++i) {
                const Vec2 p(random.uniform(-1, 1), random.uniform(-1, 1));
                CHECK(contains(c, p) == inside(p));
            }
        }
    }

    TEST_CASE("a polygon cut by the lines of another: inside plus outside is the whole") {
        Random random(23);
        for (int trial = 0; trial < 100; ++trial) {
            const Polygon a = randomPolygon(random, 7, 1, {0, 0});
            const Polygon b = randomPolygon(random, 5, 1, {random.uniform(-1, 1), random.uniform(-1, 1)});
            double outside = 0;
            Polygon rest = a;
            for (std::size_t i = 0; i < b.size() && !rest.empty(); ++i) {
                const Vec2 edge = b.next(i) - b[i], normal(edge.y(), -edge.x());
                outside += area(clipHalfPlane(rest, -normal, -normal.dot(b[i])));
                rest = clipHalfPlane(rest, normal, normal.dot(b[i]));
            }
            CHECK(area(rest) == within(1e-11, area(intersect(a, b))));
            CHECK(area(rest) + outside == within(1e-12, area(a)));
        }
    }

    TEST_CASE("equal, shared and nearly equal outlines do not breed vertices") {
        Random random(24);
        for (int trial = 0; trial < 200; ++trial) {
            const double angle = random.uniform(0, 6);
            const Polygon a = turned(rectangle(0, 0, 0.2, 0.1), angle);
            Polygon noisy;
            for (const Vec2& p : a)
                noisy.push(p + Vec2(random.uniform(-1, 1), random.uniform(-1, 1)) * 1e-14);
            const Polygon same = intersect(a, noisy);
            CHECK(same.size() == 4);
            CHECK(area(same) == within(1e-12, 0.02));
            // Half of it, sharing three edges.
            const Polygon half = intersect(a, turned(rectangle(0, 0, 0.1, 0.1), angle));
            CHECK(half.size() == 4);
            CHECK(area(half) == within(1e-12, 0.01));
        }
    }

    TEST_CASE("polygons that only touch, and slivers, have nothing in common") {
        const Polygon a = rectangle(0, 0, 1, 1);
        CHECK(intersect(a, rectangle(1, 0, 2, 1)).empty());
        CHECK(intersect(a, rectangle(1, 1, 2, 2)).empty());
        CHECK(intersect(a, rectangle(1.5, 0, 2, 1)).empty());
        CHECK(intersect(a, rectangle(1 - 0.5 * kSliver, 0, 2, 1)).empty());
        CHECK(area(intersect(a, rectangle(1 - 1e-9, 0, 2, 1))) == within(1e-6, 1e-9));
        CHECK(intersect(a, Polygon{}).empty());
        CHECK(intersect(Polygon{}, a).empty());
        CHECK(clipHalfPlane(a, Vec2(1, 0), 0).empty());
        CHECK(area(clipHalfPlane(a, Vec2(-3, 0), 0)) == 1);
        CHECK(clipHalfPlane(Polygon{}, Vec2(1, 0), 0).empty());
    }

    TEST_CASE("containment: the smaller one comes back whole") {
        const Polygon inner = rectangle(0.2, 0.3, 0.4, 0.9), outer = rectangle(0, 0, 1, 1);
        for (const Polygon& p : {intersect(inner, outer), intersect(outer, inner)}) {
            CHECK(p.size() == 4);
            CHECK(area(p) == within(1e-14, 0.12));
        }
    }

    TEST_CASE("many vertices spill to the heap and back without loss") {
        Random random(25);
        const Polygon many = randomPolygon(random, 200, 1, {0, 0});
        REQUIRE(many.size() == 200);
        Polygon copy = many;
        CHECK(std::equal(copy.begin(), copy.end(), many.begin(), many.end()));
        while (copy.size() > 20) copy.pop();
        CHECK(std::equal(copy.begin(), copy.end(), many.begin(), many.begin() + 20));
        copy.push(copy[0]);
        CHECK(copy[20] == many[0]);
        copy = many;
        CHECK(area(intersect(copy, many)) == within(1e-12, area(many)));
        const Polygon square = rectangle(0, 0, 2, 2);
        const auto inside = [&](const Vec2& p) { return contains(many, p) && contains(square, p); };
        CHECK(area(intersect(many, square)) == within(4e-3, countedArea(1, 1000, inside)));
        copy = square;
        CHECK(copy.size() == 4);
        copy.clear();
        CHECK(copy.empty());
    }

    TEST_CASE("simplify drops what is on a line or doubled, and keeps corners") {
        const double e = 1e-9;
        const Polygon p{Vec2(0.5, -e),    Vec2(1, 0),     Vec2(1, e),    Vec2(1 + e, 0.5), Vec2(1, 1),
                        Vec2(0.5, 1 + e), Vec2(0, 1 - e), Vec2(-e, 0.5), Vec2(0, 0)};
        const Polygon simple = simplify(p, 1e-6);
        REQUIRE(simple.size() == 4);
        CHECK(area(simple) == within(1e-8, 1));
        CHECK(simplify(rectangle(0, 0, 1, 1), 1e-6).size() == 4);
        CHECK(simplify(rectangle(0, 0, 1, 1e-7), 1e-6).empty());
        CHECK(simplify(Polygon{}, 1e-6).empty());
        Random random(26);
        const Polygon round = randomPolygon(random, 30, 1, {0, 0});
        CHECK(simplify(round, 1e-9).size() == 30);
    }

    TEST_CASE("two outlines turned against each other by nearly nothing: four corners, not eight") {
        const Polygon a = rectangle(-0.1, -0.05, 0.1, 0.05);
        const Polygon raw = intersect(a, turned(a, 1e-8));
        CHECK(raw.size() == 8);
        CHECK(simplify(raw, 1e-6 * extent(raw)).size() == 4);
        CHECK(simplify(intersect(a, turned(a, 0.1)), 1e-6 * extent(raw)).size() == 8);
    }
}
