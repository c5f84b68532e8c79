#include "geometry/pressure.h"

#include <doctest/doctest.h>

#include "engine/geometry/random_shapes.h"

using namespace talus;
using namespace talus::test;

namespace {

using Sums = Eigen::Vector3d;  // force, moment_x, moment_y

Sums at(const LinearPressure& p, const Vec2& x) { return p.at(x) * Sums(1, x.x(), x.y()); }

/// The oracle: triangles cut into quarters wherever the water line crosses them. The midpoint rule is exact
/// for degree 2, so only the line's own triangles are approximate, by 4^-depth of the whole.
Sums quadrature(const LinearPressure& p, const Vec2& a, const Vec2& b, const Vec2& c, int depth) {
    const double low = std::min({p.at(a), p.at(b), p.at(c)}), high = std::max({p.at(a), p.at(b), p.at(c)});
    if (high <= 0) return Sums::Zero();
    const Vec2 ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
    const Vec2 u = b - a, v = c - a;
    if (low >= 0) return (u.x() * v.y() - u.y() * v.x()) / 6 * (at(p, ab) + at(p, bc) + at(p, ca));
    if (depth == 0)
        return (u.x() * v.y() - u.y() * v.x()) / 2 * std::max(0.0, p.at((a + b + c) / 3)) *
               at({1, Vec2::Zero()}, (a + b + c) / 3);
    return quadrature(p, a, ab, ca, depth - 1) + quadrature(p, ab, b, bc, depth - 1) +
           quadrature(p, ca, bc, c, depth - 1) + quadrature(p, ab, bc, ca, depth - 1);
}

Sums quadrature(const LinearPressure& p, const Polygon& polygon) {
    Sums sum = Sums::Zero();
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sum += quadrature(p, centroid(polygon), polygon[i], polygon.next(i), 13);
    return sum;
}

Sums sums(const Thrust& thrust) { return {thrust.force, thrust.moment_x, thrust.moment_y}; }

double highest(const LinearPressure& p, const Polygon& polygon) {
    double most = p.at(polygon[0]);
    for (const Vec2& x : polygon) most = std::max(most, p.at(x));
    return most;
}

}  // namespace

TEST_SUITE("geometry") {
    TEST_CASE("a wall with water up to half its height: rho g w H^2 / 2, a third up") {
        const double rho_g = 9810, width = 0.3, depth = 0.35;
        const Polygon wall{Vec2(0, 0), Vec2(width, 0), Vec2(width, 0.7), Vec2(0, 0.7)};
        const auto i = thrustOn(wall, {rho_g * depth, {0, -rho_g}});
        const double force = rho_g * width * depth * depth / 2;
        CHECK(i.force == within(1e-14, force));
        CHECK(i.moment_x == within(1e-14, force * width / 2));
        CHECK(i.moment_y == within(1e-14, force * depth / 3));
        CHECK(area(wetPart(wall, {rho_g * depth, {0, -rho_g}})) == within(1e-14, width * depth));
    }

    TEST_CASE("a wall under the water: trapezoid of pressure") {
        const Polygon wall{Vec2(1, 1), Vec2(3, 1), Vec2(3, 2), Vec2(1, 2)};
        const auto i = thrustOn(wall, {10, {2, -1}});  // p = 10 + 2x - y
        CHECK(i.force == within(1e-15, 2 * (10 + 4 - 1.5)));
        CHECK(i.moment_x == within(1e-14, 2 * (2 * (10 + 4 - 1.5) + 2.0 * 4 / 12)));
        CHECK(i.moment_y == within(1e-14, 2 * (1.5 * (10 + 4 - 1.5) - 1.0 / 12)));
        CHECK(wetPart(wall, {10, {2, -1}}).size() == 4);
    }

    TEST_CASE("random polygons and pressures against quadrature, wet, dry and in part") {
        Random random(31);
        int wet = 0, dry = 0, part = 0;
        for (int trial = 0; trial < 150; ++trial) {
            const Polygon polygon = randomPolygon(random, random.integer(3, 10), random.uniform(0.1, 2),
                                                  {random.uniform(-2, 2), random.uniform(-2, 2)});
            const LinearPressure p{random.uniform(-3e3, 3e3),
                                   {random.uniform(-2e3, 2e3), random.uniform(-2e3, 2e3)}};
            const Thrust found = thrustOn(polygon, p);
            const Polygon found_wet = wetPart(polygon, p);
            const Sums expected = quadrature(p, polygon);
            // Relative to what full pressure would give: a wet tip of 1e-4 is beyond the oracle, not the
            // engine.
            const double scale =
                std::max(expected.norm(), 1e-2 * area(polygon) * std::abs(highest(p, polygon)));
            CHECK((sums(found) - expected).norm() <= 1e-6 * scale);
            const double share = area(found_wet) / area(polygon);
            (found_wet.empty() ? dry : share > 1 - 1e-12 ? wet : part)++;
            CHECK(found_wet.empty() == (highest(p, polygon) <= 0));
            for (const Vec2& x : found_wet) CHECK(p.at(x) > -1e-8);
        }
        CHECK(wet > 20);
        CHECK(dry > 20);
        CHECK(part > 20);
    }

    TEST_CASE("a pressure that is positive all over a polygon: its moments give the same thrust") {
        Random random(33);
        for (int trial = 0; trial < 100; ++trial) {
            const Polygon polygon = randomPolygon(random, random.integer(3, 10), random.uniform(0.1, 2),
                                                  {random.uniform(-2, 2), random.uniform(-2, 2)});
            const LinearPressure p{random.uniform(2e4, 3e4),
                                   {random.uniform(-2e3, 2e3), random.uniform(-2e3, 2e3)}};
            const Thrust found = thrustOnWhole(momentsOf(polygon), p);
            const Sums expected = sums(thrustOn(polygon, p));
            CHECK((Sums(found.force, found.moment_x, found.moment_y) - expected).norm() <=
                  1e-13 * expected.norm());
        }
    }

    TEST_CASE("constant pressure, no pressure, suction, no polygon") {
        Random random(32);
        const Polygon p = randomPolygon(random, 6, 1, {5, 6});
        const auto full = thrustOn(p, {100, Vec2::Zero()});
        CHECK(full.force == within(1e-14, 100 * area(p)));
        CHECK(full.moment_y == within(1e-14, 100 * area(p) * centroid(p).y()));
        CHECK(thrustOn(p, {0, Vec2::Zero()}).force == 0);
        CHECK(thrustOn(p, {-100, Vec2::Zero()}).force == 0);
        CHECK(wetPart(p, {-100, Vec2::Zero()}).empty());
        CHECK(thrustOn(Polygon{}, {100, Vec2::Zero()}).force == 0);
    }

    TEST_CASE("corners and edges on the water line") {
        const Polygon square{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
        const auto sumsOf = [&](const LinearPressure& p) { return sums(thrustOn(square, p)); };
        CHECK((sumsOf({0, {0, 1}}) - Sums(0.5, 0.25, 1.0 / 3)).norm() < 1e-15);             // p = y
        CHECK(sumsOf({0, {0, -1}}).norm() == 0);                                            // p = -y
        CHECK((sumsOf({0, {1, -1}}) - Sums(1.0 / 6, 0.125, 1.0 / 24)).norm() < 1e-15);      // p = x - y
        CHECK((sumsOf({1, {-1, -1}}) - Sums(1.0 / 6, 1.0 / 24, 1.0 / 24)).norm() < 1e-15);  // p = 1 - x - y
        for (const double least : {0.0, 1e-15, -1e-15}) {
            const LinearPressure p{least, {3, 5}};
            const Thrust whole = thrustOnWhole(momentsOf(square), p);
            CHECK((Sums(whole.force, whole.moment_x, whole.moment_y) - sumsOf(p)).norm() < 1e-14);
        }
    }

    TEST_CASE("the force grows smoothly with the water level, from the first drop on") {
        const Polygon tip{Vec2(0, 0), Vec2(1, 1), Vec2(-1, 1)};  // width 2 y: force = rho g H^3 / 3
        for (double depth = 1e-5; depth < 1; depth *= 3)
            CHECK(thrustOn(tip, {9810 * depth, {0, -9810}}).force ==
                  within(1e-7, 9810 * depth * depth * depth / 3));
    }
}
