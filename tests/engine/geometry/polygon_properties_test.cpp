// Clipping of convex polygons, whatever they are: areas add up, nothing lies outside, what comes out is a
// convex polygon again, counter-clockwise.

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "geometry/polygon.h"
#include "support/properties.h"

using namespace talus;
using namespace talus::test;

namespace {

/// Corners on an ellipse, by fractions of its round: convex, at least three of them apart.
rc::Gen<std::vector<Vec2>> convexCorners() {
    const auto corner = rc::gen::inRange(0, 360);
    const auto angles =
        rc::gen::suchThat(rc::gen::unique<std::vector<int>>(corner), [](std::vector<int> degrees) {
            std::sort(degrees.begin(), degrees.end());
            for (std::size_t k = 0; k < degrees.size();
                 ++k) {  // no half of the ellipse without a corner: some width
                const int next = k + 1 < degrees.size() ? degrees[k + 1] : degrees[0] + 360;
                if (next - degrees[k] >= 175) return false;
            }
            return degrees.size() >= 3;
        });
    const auto shape = rc::gen::tuple(angles, numberIn(0.2, 3), numberIn(0.2, 3), numberIn(-2, 2),
                                      numberIn(-2, 2), numberIn(0, 3));
    return rc::gen::map(shape, [](const auto& drawn) {
        auto [degrees, a, b, x, y, turn] = drawn;
        std::sort(degrees.begin(), degrees.end());
        std::vector<Vec2> corners;
        for (const int angle : degrees) {
            const double t = angle * 3.14159265358979 / 180;
            corners.push_back(Vec2(x, y) + Eigen::Rotation2Dd(turn) * Vec2(a * std::cos(t), b * std::sin(t)));
        }
        return corners;
    });
}

/// Generators do not draw vectors of Eigen or polygons themselves: they could not be shown.
Polygon polygonOf(const std::vector<Vec2>& corners) {
    Polygon polygon;
    for (const Vec2& corner : corners) polygon.push(corner);
    return polygon;
}

struct Line {
    Vec2 normal;
    double offset;
};

Line drawLine() {
    const double angle = *numberIn(0, 6.283);
    const Vec2 normal(std::cos(angle), std::sin(angle));
    return {normal, *numberIn(-4, 4)};
}

bool isConvex(const Polygon& polygon) {
    const double rounding = 1e-12 * extent(polygon) * extent(polygon);
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2 in = polygon.next(k) - polygon[k],
                   out = polygon.next((k + 1) % polygon.size()) - polygon.next(k);
        if (in.x() * out.y() - in.y() * out.x() < -rounding) return false;
    }
    return polygon.empty() || (polygon.size() >= 3 && area(polygon) > 0);
}

/// How far the corners of one polygon lie outside another at most [m].
double outside(const Polygon& inner, const Polygon& outer) {
    double most = 0;
    for (const Vec2& corner : inner)
        for (std::size_t k = 0; k < outer.size(); ++k) {
            const Vec2 side = (outer.next(k) - outer[k]).normalized();
            most = std::max(most, Vec2(side.y(), -side.x()).dot(corner - outer[k]));
        }
    return most;
}

double areaOf(const Polygon& polygon) { return polygon.empty() ? 0.0 : area(polygon); }

}  // namespace

TEST_SUITE("geometry") {
    TEST_CASE("property: a line parts a polygon into two convex ones whose areas and first moments add up") {
        checkProperty("parted by a line", 500, [] {
            const Polygon whole = polygonOf(*convexCorners());
            const auto [normal, offset] = drawLine();
            const Polygon below = clipHalfPlane(whole, normal, offset),
                          above = clipHalfPlane(whole, -normal, -offset);
            RC_ASSERT(isConvex(below) && isConvex(above));
            RC_ASSERT(outside(below, whole) < 1e-11 && outside(above, whole) < 1e-11);
            for (const Vec2& corner : below) RC_ASSERT(normal.dot(corner) <= offset + 1e-11);
            for (const Vec2& corner : above) RC_ASSERT(normal.dot(corner) >= offset - 1e-11);
            RC_ASSERT(std::abs(areaOf(below) + areaOf(above) - area(whole)) < 1e-11 * (1 + area(whole)));
            Vec2 moment = -area(whole) * centroid(whole);
            for (const Polygon& part : {below, above})
                if (!part.empty()) moment += area(part) * centroid(part);
            RC_ASSERT(moment.norm() < 1e-10 * (1 + area(whole)));
        });
    }

    TEST_CASE(
        "property: what two polygons have in common is convex, in both, the same either way, and adds up") {
        int common = 0;
        checkProperty("common part", 500, [&] {
            const Polygon a = polygonOf(*convexCorners()), b = polygonOf(*convexCorners());
            const Polygon both = intersect(a, b), back = intersect(b, a);
            common += !both.empty();
            RC_ASSERT(isConvex(both));
            RC_ASSERT(outside(both, a) < 1e-11 && outside(both, b) < 1e-11);
            RC_ASSERT(std::abs(areaOf(both) - areaOf(back)) < 1e-11);
            // What is left of a, side by side of b: beyond its k-th line, within those before.
            double rest = 0;
            Polygon left = a;
            for (std::size_t k = 0; k < b.size() && !left.empty(); ++k) {
                const Vec2 side = b.next(k) - b[k], out(side.y(), -side.x());
                rest += areaOf(clipHalfPlane(left, -out, -out.dot(b[k])));
                left = clipHalfPlane(left, out, out.dot(b[k]));
            }
            RC_ASSERT(std::abs(areaOf(left) - areaOf(both)) < 1e-10);
            RC_ASSERT(std::abs(rest + areaOf(both) - area(a)) < 1e-10 * (1 + area(a)));
        });
        CHECK(common > 100);
    }

    TEST_CASE("property: a polygon and itself, and a polygon within another, have all of it in common") {
        checkProperty("contained", 300, [] {
            const Polygon whole = polygonOf(*convexCorners());
            RC_ASSERT(std::abs(areaOf(intersect(whole, whole)) - area(whole)) < 1e-12 * area(whole));
            const Vec2 centre = centroid(whole);
            const double share = *numberIn(0.05, 0.95);
            Polygon within;
            for (const Vec2& corner : whole) within.push(centre + share * (corner - centre));
            RC_ASSERT(std::abs(areaOf(intersect(whole, within)) - area(within)) < 1e-11 * area(whole));
            RC_ASSERT(std::abs(areaOf(intersect(within, whole)) - share * share * area(whole)) <
                      1e-11 * area(whole));
        });
    }
}
