// Rings around where a field is above a level: closed, in the right place, with holes and saddles.

#include "report/contours.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace talus::tools;

namespace {

double areaOf(const std::vector<Spot>& ring) {
    double twice = 0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const Spot &a = ring[k], &b = ring[(k + 1) % ring.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return twice / 2;
}

}  // namespace

TEST_CASE("contours: a cone's ring is a circle, counter-clockwise") {
    const Field field = sampled(201, 1, [](Spot at) { return 1 - std::hypot(at.x, at.y); });
    const auto rings = ringsAbove(field, 0.4);
    REQUIRE(rings.size() == 1);
    for (const Spot& spot : rings[0]) CHECK(std::hypot(spot.x, spot.y) == doctest::Approx(0.6).epsilon(1e-3));
    CHECK(areaOf(rings[0]) == doctest::Approx(3.14159265 * 0.36).epsilon(1e-3));
    CHECK(ringsAbove(field, 1.1).empty());
}

TEST_CASE("contours: a hole is a ring the other way round") {
    const Field field = sampled(201, 1, [](Spot at) { return 0.2 - std::abs(std::hypot(at.x, at.y) - 0.5); });
    const auto rings = ringsAbove(field, 0.1);
    REQUIRE(rings.size() == 2);
    double area = 0;
    for (const auto& ring : rings) area += areaOf(ring);
    CHECK(area == doctest::Approx(3.14159265 * (0.36 - 0.16)).epsilon(1e-3));
}

TEST_CASE("contours: what runs over the border is closed along it") {
    const auto rings = ringsAbove(sampled(41, 1, [](Spot at) { return at.x; }), 0.0);
    REQUIRE(rings.size() == 1);
    CHECK(areaOf(rings[0]) == doctest::Approx(1.95).epsilon(0.05));
}

TEST_CASE("contours: a saddle's corners are one area or two, as its middle is above or below") {
    const auto saddle = [](double middle) {
        return sampled(4, 1.5, [middle](Spot at) {
            const bool inner = std::abs(at.x) < 1 && std::abs(at.y) < 1;
            return !inner ? -1.0 : at.x * at.y > 0 ? 1 + middle : -1 + middle;
        });
    };
    CHECK(ringsAbove(saddle(0.5), 0).size() == 1);
    CHECK(ringsAbove(saddle(-0.5), 0).size() == 2);
}
