// What of a painted picture is to be seen: what is left out is what later polygons cover.

#include "report/hidden_parts.h"

#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <random>

#include "support/properties.h"
#include "support/slower.h"

using namespace talus;
using namespace talus::tools;

namespace {

/// How far inside a polygon a place of the picture lies; negative outside.
double depthIn(const PaintedPolygon& polygon, const Vec3& place) {
    double depth = 1e300;
    for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
        const Vec3 &a = polygon.corners[k], &b = polygon.corners[(k + 1) % polygon.corners.size()];
        const double length = std::hypot(b.x() - a.x(), b.y() - a.y());
        depth = std::min(
            depth, ((b.x() - a.x()) * (place.y() - a.y()) - (b.y() - a.y()) * (place.x() - a.x())) / length);
    }
    return depth;
}

std::vector<PaintedPolygon> drawnTriangles(unsigned seed, int count, double size) {
    std::vector<PaintedPolygon> painted;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    const auto number = [&] { return share(random); };
    while (static_cast<int>(painted.size()) < count) {
        const Vec3 a(number(), number(), 0);
        const Vec3 b = a + size * Vec3(number() - 0.5, number() - 0.5, 0),
                   c = a + size * Vec3(number() - 0.5, number() - 0.5, 0);
        const double twice = (b - a).cross(c - a).z();
        if (std::abs(twice) < 1e-3 * size * size) continue;
        painted.push_back({twice > 0 ? std::vector{a, b, c} : std::vector{a, c, b},
                           {Side::rim, Side::joint, Side::crease},
                           painted.size()});
    }
    return painted;
}

/// The number of what is painted last at a place, well inside.
std::optional<std::size_t> lastAt(const std::vector<PaintedPolygon>& painted, const Vec3& place) {
    std::optional<std::size_t> last;
    for (const PaintedPolygon& polygon : painted)
        if (depthIn(polygon, place) > 0) last = polygon.source;
    return last;
}

/// Of a side, by places along it, how much no later polygon covers.
double seenLength(const std::vector<PaintedPolygon>& painted, std::size_t k, std::size_t side) {
    constexpr int kPlaces = 400;
    const Vec3 &a = painted[k].corners[side], &b = painted[k].corners[(side + 1) % 3];
    int seen = 0;
    for (int i = 0; i < kPlaces; ++i) {
        const Vec3 place = a + (i + 0.5) / kPlaces * (b - a);
        bool covered = false;
        for (std::size_t later = k + 1; later < painted.size() && !covered; ++later)
            covered = depthIn(painted[later], place) > 2e-4;
        seen += covered ? 0 : 1;
    }
    return (b - a).norm() * seen / kPlaces;
}

}  // namespace

TEST_SUITE("hidden parts") {
    TEST_CASE(
        "triangles on each other: what is seen last anywhere stays so, and lines end where they are "
        "covered") {
        for (const auto& many : {std::pair{8, 1.5}, std::pair{60, 0.5}, std::pair{60, 1.5}}) {
            const auto count = many.first;
            const auto size = many.second;
            CAPTURE(count);
            CAPTURE(size);
            test::checkProperty("what is seen", test::kTriesFew ? 2 : 10, [count, size] {
                const std::vector<PaintedPolygon> painted =
                    drawnTriangles(*rc::gen::arbitrary<unsigned>(), count, size);
                const SeenParts seen = seenParts(painted);
                for (int i = 0; i < 400; ++i) {
                    const Vec3 place(0.013 + 0.97 * (i % 20) / 20, 0.017 + 0.97 * (i / 20) / 20, 0);
                    RC_ASSERT(lastAt(seen.polygons, place) == lastAt(painted, place));
                }
                double by_kind[4] = {}, expected[4] = {}, whole = 0;
                for (const SeenLine& line : seen.lines)
                    by_kind[static_cast<int>(line.side)] += (line.to - line.from).norm();
                for (std::size_t k = 0; k < painted.size(); ++k)
                    for (std::size_t side = 0; side < 3; ++side) {
                        const double length = seenLength(painted, k, side);
                        expected[static_cast<int>(painted[k].sides[side])] += length;
                        whole += length;
                    }
                for (int kind = 0; kind < 4; ++kind)
                    RC_ASSERT(std::abs(by_kind[kind] - expected[kind]) < 0.005 * whole);
            });
        }
    }

    TEST_CASE(
        "what lies under others wholly is left out, with its sides; what they leave a strip of is not") {
        const auto square = [](double left, double right, std::size_t source) {
            return PaintedPolygon{{{left, 0, 0}, {right, 0, 0}, {right, 1, 0}, {left, 1, 0}},
                                  {Side::joint, Side::joint, Side::joint, Side::joint},
                                  source};
        };
        PaintedPolygon low = square(0.2, 0.8, 0);
        for (Vec3& corner : low.corners) corner.y() = 0.25 + 0.5 * corner.y();
        for (const double gap : {0.0, 0.1}) {
            CAPTURE(gap);
            const SeenParts seen = seenParts({low, square(0, 0.5, 1), square(0.5 + gap, 1, 2)});
            CHECK(seen.polygons.size() == (gap > 0 ? 3u : 2u));
            double length = 0;
            for (const SeenLine& line : seen.lines)
                length += line.from.y() == low.corners[0].y() || line.from.y() == low.corners[2].y()
                              ? (line.to - line.from).norm()
                              : 0;
            CHECK(length == doctest::Approx(2 * gap).epsilon(0.01));
        }
    }
}
